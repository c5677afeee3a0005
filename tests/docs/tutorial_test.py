"""docs/tutorial.md: its files are valid, its commands run in the order of the page and print what it shows.

Commands that run in real time, over socketcand, are not run here: their options are looked up in the command's --help,
and tests/can/setup_program_test.py runs them. With --picture it draws docs/pictures/tutorial.svg again.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "tutorial.md"
PICTURE = ROOT / "docs" / "pictures" / "tutorial.svg"
PROGRAMS = pathlib.Path(os.environ.get("SUPERCOIL", ROOT / "build" / "release" / "bin" / "supercoil")).parent
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)
SAVED_AS = re.compile(r"Save it as `([\w.-]+)`:\n\n\Z")
LIVE = "socketcand:"
MARK = "== block "


def blocks():
    """(kind, text, name of the file if it is one) of each block of the page, in order."""
    page = PAGE.read_text()
    for found in FENCE.finditer(page):
        name = SAVED_AS.search(page[:found.start()])
        yield found[1], found[2], name[1] if name else ""


def walk(folder):
    """The output of each block of commands, by its place on the page."""
    script = ["set -euo pipefail"]
    for place, (kind, text, name) in enumerate(blocks()):
        if kind == "toml":
            script += [f"cat >{name} <<'END_OF_FILE'", text + "END_OF_FILE"]
        elif kind == "sh" and LIVE not in text:
            script += [f"echo '{MARK}{place}'", text]
    (folder / "firmware").symlink_to(ROOT / "firmware")
    environment = {**os.environ, "PATH": f"{PROGRAMS}:{os.environ['PATH']}"}
    done = subprocess.run(["bash", "-c", "\n".join(script)], cwd=folder, env=environment, text=True,
                          capture_output=True)
    if done.returncode:
        raise AssertionError(f"the tutorial's commands ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    printed = done.stdout.split(MARK)[1:]
    return {int(number): text for number, _, text in (part.partition("\n") for part in printed)}


class Tutorial(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.printed = walk(cls.folder)

    def test_every_command_prints_what_the_page_shows(self):
        shown = 0
        place_of_commands = -1
        for place, (kind, text, _) in enumerate(blocks()):
            if kind == "sh":
                place_of_commands = place
            elif not kind and place_of_commands in self.printed:
                rest = self.printed[place_of_commands]
                for line in text.splitlines():
                    if line != "...":
                        self.assertIn(f"{line}\n", rest)
                        rest = rest[rest.index(f"{line}\n"):]
                        shown += 1
        self.assertGreater(shown, 10)

    def test_every_file_is_named_and_used(self):
        names = [name for kind, _, name in blocks() if kind == "toml"]
        self.assertEqual(names, ["answers.toml", "my-muscle.toml", "my-motion.toml"])
        command = [PROGRAMS / "supercoil-sim", "run", "my-muscle.toml", "--board", "board.toml", "--check"]
        checked = subprocess.run(command, cwd=self.folder / "tutorial", capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_live_commands_use_only_documented_options(self):
        live = [line for kind, text, _ in blocks() if kind == "sh" for line in text.splitlines() if LIVE in line]
        self.assertGreater(len(live), 4)
        for line in live:
            words = shlex.split(line)
            help_output = subprocess.run([PROGRAMS / words[0], words[1], "--help"], capture_output=True, text=True, check=True)
            for option in (word for word in words if word.startswith("--")):
                self.assertRegex(help_output.stdout, rf"(?m)^  (-\w,)?{option}\b", line)

    def test_the_same_muscle_is_in_both_scenarios(self):
        plants = [re.search(r"\[plant\]\n.*?\n\n", text, re.S)[0] for kind, text, _ in blocks() if "[plant]" in text]
        self.assertEqual(len(plants), 2)
        self.assertEqual(*plants)


if __name__ == "__main__":
    if "--picture" in sys.argv:
        with tempfile.TemporaryDirectory() as scratch:
            walk(pathlib.Path(scratch))
            shutil.copy(pathlib.Path(scratch, "tutorial/supercoil-out/my-motion/plot.svg"), PICTURE)
    else:
        unittest.main()
