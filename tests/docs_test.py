"""The documentation of faults matches firmware/core/supervisor/fault.{hpp,cpp}, and no link is dead.

Every fault has a page with its name, headed by its number, and a row in docs/faults/README.md with its number, group and
scope. Links in README.md and docs/ are followed to the file and the heading; web addresses are not. The list of all
pages, which is the site's navigation, has each page of docs/ once, and each manual page with its own description.
The drawing of the wiring is what its program draws. Whatever an operator is told to check or to set is a key of the
board's file or a signal on CAN, not a name in the code. Margins are shown in the units of the faults' pages.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
FAULTS = ROOT / "docs" / "faults"
SUPERVISOR = ROOT / "firmware" / "core" / "supervisor"

NUMBER = re.compile(r"^\s*(\w+) = (\d+),", re.M)
ENTRY = re.compile(r'\{\s*(\w+),\s*"(\w+)",\s*"(\w+)",\s*(channel|board),')
ROW = re.compile(r"^\|\s*(\d+)\s*\|\s*\[(\w+)\](?:\([^)]*\))?\s*\|\s*(\w+)\s*\|\s*(\w+)\s*\|", re.M)
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.M | re.S)
INLINE_LINK = re.compile(r"\[[^\]]*\]\(\s*<?([^)\s>]+)")
LINK_DEFINITION = re.compile(r"^\[([^\]]+)\]:\s*(\S+)", re.M)
LIST_ITEM = re.compile(r"^- \[[^\]]+\]\(([^)#]+)\)", re.M)
HEADING = re.compile(r"^#+\s+(.*?)\s*$", re.M)


def faults_in_code():
    """(name → (number, group, scope)), and the problems in the sources themselves."""
    enumeration = re.search(r"enum class Fault\b.*?\{(.*?)\};", (SUPERVISOR / "fault.hpp").read_text(), re.S)
    numbers = {name: int(number) for name, number in NUMBER.findall(enumeration.group(1) if enumeration else "")}
    numbers.pop("none", None)
    entries = ENTRY.findall((SUPERVISOR / "fault.cpp").read_text())
    found = {name: (numbers.get(member), group, scope) for member, name, group, scope in entries}
    wrong = []
    if not found:
        wrong.append("fault.cpp: no fault found: has it moved, or its form changed?")
    for name in numbers.keys() - found.keys():
        wrong.append(f"fault.cpp: {name} of fault.hpp is not described")
    for name, (number, _, _) in found.items():
        if number is None:
            wrong.append(f"fault.hpp: {name} of fault.cpp has no number")
    return found, wrong


def problems_of_faults():
    faults, wrong = faults_in_code()
    yield from wrong
    readme = (FAULTS / "README.md").read_text()
    rows = ROW.findall(readme)
    listed = [name for _, name, _, _ in rows]
    for name in sorted({name for name in listed if listed.count(name) > 1}):
        yield f"docs/faults/README.md: {name} has more than one row"
    for number, name, group, scope in rows:
        if name not in faults:
            yield f"docs/faults/README.md: {name} is no fault"
        elif (int(number), group, scope) != faults[name]:
            yield f"docs/faults/README.md: {name} is {number}, {group}, {scope}; in the code {faults[name]}"
    for name, (number, _, _) in faults.items():
        page = FAULTS / f"{name}.md"
        if name not in listed:
            yield f"docs/faults/README.md: no row for {name}"
        if not page.is_file():
            yield f"docs/faults/{name}.md: missing"
        elif not page.read_text().startswith(f"# {number} {name}\n"):
            yield f"docs/faults/{name}.md: is not headed '# {number} {name}'"
    for page in sorted(FAULTS.glob("*.md")):
        if page.name != "README.md" and page.stem not in faults:
            yield f"docs/faults/{page.name}: there is no such fault"


def anchors(text):
    """The anchors that GitHub makes from headings."""
    for heading in HEADING.findall(CODE.sub(lambda code: code.group().strip("`"), text)):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        yield re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def problems_of_links():
    for file in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
        text = CODE.sub("", file.read_text())
        definitions = LINK_DEFINITION.findall(text)
        for target in INLINE_LINK.findall(text) + [target for _, target in definitions]:
            if re.match(r"[a-z][a-z0-9+.-]*:", target):
                continue
            path, _, anchor = target.partition("#")
            there = (file.parent / path) if path else file
            where = file.relative_to(ROOT)
            if not there.exists():
                yield f"{where}: {target} does not exist"
            elif anchor and there.suffix == ".md" and anchor not in anchors(there.read_text()):
                yield f"{where}: {target}: no such heading"
        if file == FAULTS / "README.md":
            defined = {name for name, _ in definitions}
            for _, name, _, _ in ROW.findall(text):
                if name not in defined and f"[{name}](" not in text:
                    yield f"docs/faults/README.md: the row of {name} leads nowhere"


def problems_of_navigation():
    index = (ROOT / "docs" / "README.md").read_text()
    listed = LIST_ITEM.findall(index)
    pages = {page.name for page in (ROOT / "docs").glob("*.md")} | {"api/README.md", "faults/README.md", "../CHANGELOG.md"}
    for page in sorted((ROOT / "docs" / "man").glob("*.[1-8]")):
        pages.add(f"man/{page.name}")
        about = re.search(r"^\.Nd (.+)$", page.read_text(), re.M)[1].replace("\\-", "-")
        if f"- [{page.stem}](man/{page.name}): {about}\n" not in index:
            yield f"docs/README.md: not as docs/man/{page.name} says: {about}"
    for page in sorted(pages - {"README.md", *listed}):
        yield f"docs/README.md: {page} is not listed"
    for page in sorted({page for page in listed if listed.count(page) > 1}):
        yield f"docs/README.md: {page} is listed more than once"


def problems_of_drawing():
    """For the wiring, whose lines and addresses come from a configuration."""
    with tempfile.TemporaryDirectory() as folder:
        drawn = pathlib.Path(folder, "wiring.svg")
        subprocess.run([ROOT / "toolchain" / "wiring", drawn], check=True)
        if drawn.read_text() != (ROOT / "docs/pictures/wiring.svg").read_text():
            yield "docs/pictures/wiring.svg: not as toolchain/wiring draws it"


def problems_of_results():
    """For each bad end of identify and calibrate, programs refer to docs/troubleshooting.md for what to do."""
    source = (ROOT / "firmware" / "core" / "modes" / "result.hpp").read_text()
    names = re.findall(r'"(\w+)"', re.search(r"mode_result_names\{(.*?)\}", source, re.S)[1])
    page = (ROOT / "docs" / "troubleshooting.md").read_text()
    part = page[page.index("## identify refuses the muscle"):].split("\n## ")[0]
    for name in set(names) - {"none", "running", "found"}:
        if f"`{name}`" not in part:
            yield f"docs/troubleshooting.md: does not say what to do about {name}"


def problems_of_messages():
    """Where programs are installed there is no folder docs/: their messages name pages of `supercoil docs`."""
    sources = [path for folder in ("firmware", "host_sim") for path in sorted((ROOT / folder).rglob("*.[ch]pp"))]
    for source in sources:
        for number, line in enumerate(source.read_text().splitlines(), 1):
            code, where = line.split("//")[0], f"{source.relative_to(ROOT)}:{number}"
            if re.search(r"docs/[\w/-]+\.md", code):
                yield f"{where}: names a file of the sources: use documentation_page()"
            for page in re.findall(r'documentation_page\("([\w/-]+)"\)', code):
                if not (ROOT / "docs" / f"{page}.md").is_file():
                    yield f"{where}: there is no page {page}"


def problems_of_units():
    """Programs and the monitor's page show a margin in the unit that its fault's page gives."""
    units = {"metres": "m", "seconds": "s", "amperes": "A", "volts": "V", "kelvin": "K", "°C": "C", "joules": "J",
             "ohms": "Ohm", "watts": "W", "steps": "steps"}
    documented = {}
    for page in FAULTS.glob("[a-z]*.md"):
        if unit := re.search(r"^## Margin\n\n(?:In ([\w°]+))?", page.read_text(), re.M)[1]:
            documented[page.stem] = units.get(unit, unit)
    source = (ROOT / "firmware/io/text/margin_unit.hpp").read_text()
    code = {name: unit for names, unit in re.findall(r'((?:\s*case Fault::\w+:)+)\s*return "([^"]+)"', source)
            for name in re.findall(r"::(\w+)", names)}
    script = (ROOT / "firmware/apps/supercoil/monitor/page/margins.js").read_text()
    shown = dict(re.findall(r'(\w+): "([^"]*)"', re.search(r"UNITS = \{(.*?)\}", script, re.S)[1]))
    shown = {name: {"°C": "C", "Ω": "Ohm"}.get(unit, unit) for name, unit in shown.items()}
    for where, given in (("margin_unit.hpp", code), ("margins.js", shown)):
        for name in sorted(documented.keys() | given.keys()):
            if documented.get(name) != given.get(name):
                yield f"{where}: {name} is in {given.get(name)}; on its page in {documented.get(name)}"


def problems_of_keys():
    """For pages that help an operator to repair a board: words with a unit, in backquotes."""
    docs = ROOT / "docs"
    explained = "".join((docs / page).read_text() for page in ("configuration.md", "can-protocol.md", "recorder.md", "setup.md"))
    known = set(re.findall(r"\w+", explained))
    for page in [*FAULTS.glob("*.md"), *(docs / name for name in ("safety.md", "wiring.md", "materials.md", "troubleshooting.md"))]:
        for quoted in re.findall(r"`([^`\n]+)`", page.read_text()):
            for word in re.findall(r"[a-z]\w*_(?:s|ms|m|W|V|A|K|C|J|N|Hz|Ohm|deg|ratio|row)\b", quoted):
                if word not in known:
                    yield f"{page.relative_to(ROOT)}: `{word}` is neither a key of the board's file nor a signal on CAN"
        for name in re.findall(r"`[^`\n]*\w\(\)[^`\n]*`", page.read_text()):
            yield f"{page.relative_to(ROOT)}: {name} is the code's: what does an operator look at?"


if __name__ == "__main__":
    found = [*problems_of_faults(), *problems_of_results(), *problems_of_links(), *problems_of_navigation(),
             *problems_of_drawing(), *problems_of_messages(), *problems_of_units(), *problems_of_keys()]
    print("\n".join(found) or "every fault has its page and its row, every page is listed, every link leads to a file")
    sys.exit(bool(found))
