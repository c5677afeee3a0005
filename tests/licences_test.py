"""Every file in the tree has a licence whose text is in LICENSES: runs `reuse lint-file` (reuse.software) on each.

Not `reuse lint`, which also checks built and installed files when git does not tell it what belongs to the tree.
"""

import fnmatch
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def files():
    ignored = [line.strip("/") for line in (ROOT / ".gitignore").read_text().splitlines() if not line.startswith("#")]

    def is_ours(name):
        return name != ".git" and not any(fnmatch.fnmatch(name, pattern) for pattern in ignored)

    for folder, folders, names in os.walk(ROOT):
        folders[:] = filter(is_ours, folders)
        yield from (pathlib.Path(folder, name) for name in filter(is_ours, names))


if __name__ == "__main__":
    found = sorted(file for file in files() if not file.is_symlink())
    sys.exit(subprocess.run([sys.executable, "-m", "reuse", "--root", ROOT, "lint-file", "--lines", *found]).returncode)
