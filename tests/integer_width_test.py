"""No `long` in shipped code: on some machines it has 32 bits, and a count of ticks at 10 kHz overflows after 2.5 days.

std::int64_t has the same range everywhere. `long long` is allowed for formats that need it, and values that the kernel
itself declares as long have its own type (decltype(timespec::tv_nsec)).
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
LAYERS = ["control", "hal", "firmware", "host_sim"]
# A quote between digits is a digit separator.
NOT_CODE = re.compile(r"""//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])'(?:\\.|[^'\\])+'""", re.S)
LONG = re.compile(r"(?<!long )\blong\b(?! long| double)|\b\d[\d']*[uU]?[lL]\b|%l[dui]")


def blanked(code):
    """The code without comments and, except for formats, without texts; line numbers are kept."""
    def blank(found):
        text = found.group()
        kept = " ".join(re.findall(r"%l[dui]", text)) if text.startswith(("\"", "R\"")) else ""
        return kept + "\n" * text.count("\n")
    return NOT_CODE.sub(blank, code)


def problems():
    for layer in LAYERS:
        files = [f for f in (ROOT / layer).rglob("*") if f.suffix in {".hpp", ".cpp"}]
        if not files:
            yield f"{layer}: no files: has it moved?"
        for file in files:
            for number, line in enumerate(blanked(file.read_text()).split("\n"), 1):
                if LONG.search(line):
                    yield f"{file.relative_to(ROOT)}:{number}: {line.strip()}"


if __name__ == "__main__":
    found = list(problems())
    print("\n".join(found) or "no counter is a long")
    sys.exit(bool(found))
