"""The manual pages in docs/man match the programs' --help, and `man` finds nothing wrong with them.

    man_test.py PROGRAMS      the folder of the built programs
"""

import filecmp
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGES = ROOT / "docs" / "man"


def problems(programs):
    with tempfile.TemporaryDirectory() as fresh:
        generated = subprocess.run([ROOT / "toolchain/generate-man", programs, fresh], capture_output=True, text=True)
        if generated.returncode != 0:
            yield generated.stderr.strip()
            return
        names = {page.name for page in pathlib.Path(fresh).iterdir()}
        kept = {page.name for page in PAGES.iterdir() if page.suffix != ".in"}
        for name in sorted(names ^ kept):
            yield f"docs/man/{name}: {'missing' if name in names else 'has no template'}"
        for name in sorted(names & kept):
            if not filecmp.cmp(PAGES / name, pathlib.Path(fresh, name), shallow=False):
                yield f"docs/man/{name}: is not what the programs' --help gives now: toolchain/generate-man"
    # Of another form CLI11 takes from 2.4 on (Debian 13) for no name, and the program ends before it reads a command line.
    for page in sorted(PAGES.glob("*.[1-8]")):
        for name in re.findall(r"^\.It Ar (\S+)", page.read_text(), re.M):
            if not re.fullmatch(r"[A-Z]+(_[A-Z]+)*", name):
                yield f"{page.name}: {name} is no name for an argument"
    if shutil.which("man"):
        for page in sorted(PAGES.glob("*.[1-8]")):
            yield from subprocess.run(["man", "--warnings", "--local-file", page], capture_output=True,
                                      text=True).stderr.splitlines()


if __name__ == "__main__":
    found = list(problems(sys.argv[1]))
    print("\n".join(found) or "every manual page is what the programs say of themselves")
    sys.exit(bool(found))
