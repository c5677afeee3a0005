"""toolchain/demo --page, and supercoil-sim page: one command to a page whose muscle moves; nothing is left when it is ended.

Programs: environment SUPERCOIL, and supercoil-sim beside it, otherwise those of build/release.
"""

import pathlib
import shutil
import subprocess
import tempfile
import unittest

from programs import ROOT, SLACK_S, SUPERCOIL, Program, free_ports, until
from served import Served

DEMO = ROOT / "toolchain" / "demo"
PROGRAMS = pathlib.Path(SUPERCOIL).parent


class DemoPage(unittest.TestCase):
    def test_the_page_moves_the_muscle_and_both_programs_end(self):
        port = free_ports()
        demo = Program(["env", f"SUPERCOIL_PROGRAMS={PROGRAMS}", DEMO, "--page", port], r"(http://[^#\s]+/)(#token=[0-9a-f]+)?")
        self.addCleanup(demo.stop)
        served = Served(demo)

        def moved():
            if served.command("position", 0.006)[1] != {"refusal": "none"}:  # starved: its last command expired
                served.command("reset")
                served.command("arm")
            node = served.get("/api/history?from_s=-1")[1]["nodes"].get("1", {})
            return max(node.get("Measurement", {}).get("position_m", [0.0])) > 0.002

        until(lambda: served.command("arm")[1] == {"refusal": "none"}, 3 * SLACK_S)
        until(moved, 3 * SLACK_S)
        board, = subprocess.run(["pgrep", "-P", str(demo.process.pid)], capture_output=True, text=True).stdout.split()
        demo.stop()
        until(lambda: not pathlib.Path("/proc", board).exists(), SLACK_S)

    def test_page_needs_the_supercoil_program(self):
        with tempfile.TemporaryDirectory() as folder:
            prefix = pathlib.Path(folder)
            (prefix / "bin").mkdir()
            (prefix / "libexec/supercoil-sim").mkdir(parents=True)
            shutil.copy(PROGRAMS / "supercoil-sim", prefix / "bin")
            words = [prefix / "bin/supercoil-sim", "page", "--port", "0", "--out", prefix / "out"]
            for served in (words, [words[0], "docs"]):
                done = subprocess.run(served, capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stdout), (1, ""))
                self.assertIn("the program supercoil, which serves pages, was not found beside", done.stderr)
            shutil.copy(SUPERCOIL, prefix / "libexec/supercoil-sim")
            page = Program(words, r"(http://[^#\s]+/)(#token=[0-9a-f]+)?")
            self.addCleanup(page.stop)
            self.assertEqual(Served(page).get("/api/about")[0], 200)
            page.stop()

    def test_an_unknown_scenario_is_rejected_at_the_start(self):
        done = subprocess.run([PROGRAMS / "supercoil-sim", "page", "benhc"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("benhc", done.stderr)

    def test_an_unknown_option_is_rejected(self):
        done = subprocess.run([DEMO, "--pages"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("toolchain/demo --page", done.stderr)


if __name__ == "__main__":
    unittest.main()
