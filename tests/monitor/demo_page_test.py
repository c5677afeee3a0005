"""toolchain/demo --page: one command to a page whose muscle moves, and nothing is left when it is ended.

Programs: environment SUPERCOIL, and supercoil-sim beside it, else those of build/release.
"""

import pathlib
import subprocess
import unittest

from programs import ROOT, SLACK_S, SUPERCOIL, Program, free_ports, until
from served import Served

DEMO = ROOT / "toolchain" / "demo"
PROGRAMS = pathlib.Path(SUPERCOIL).parent


class DemoPage(unittest.TestCase):
    def test_the_muscle_moves_by_its_page_and_both_programs_end_with_the_command(self):
        out = ROOT / "supercoil-out" / "page"
        out.mkdir(parents=True, exist_ok=True)
        (out / "run.txt").write_text("serving can0 on 127.0.0.1:9 by an earlier run\n")
        port = free_ports()
        demo = Program(["env", f"SUPERCOIL_PROGRAMS={PROGRAMS}", DEMO, "--page", port], r"(http://[^#\s]+/)(#token=[0-9a-f]+)?")
        self.addCleanup(demo.stop)
        served = Served(demo)

        def moved():
            served.command("position", 0.006)
            node = served.get("/api/history?from_s=-1")[1]["nodes"].get("1", {})
            return max(node.get("Measurement", {}).get("position_m", [0.0])) > 0.002

        until(lambda: served.command("arm")[1] == {"refusal": "none"}, 3 * SLACK_S)
        until(moved, 3 * SLACK_S)
        begun = subprocess.run(["pgrep", "-P", str(demo.process.pid)], capture_output=True, text=True).stdout.split()
        self.assertEqual(len(begun), 2)
        demo.stop()
        self.assertEqual([one for one in begun if pathlib.Path("/proc", one).exists()], [])

    def test_what_is_no_option_is_refused(self):
        done = subprocess.run([DEMO, "--pages"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("toolchain/demo --page", done.stderr)


if __name__ == "__main__":
    unittest.main()
