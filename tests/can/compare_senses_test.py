"""supercoil doctor --compare-senses leads through a comparison on the simulated board, over socketcand."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

from live import DEADLINE_S, TRIES, Simulator

SUPERCOIL = os.environ["SUPERCOIL"]
EXAMPLE = pathlib.Path(os.environ["SUPERCOIL_EXAMPLES"]) / "raspberry-pi-pwm-ads1115.toml"
SUPPLY_V = 12.0
POWER_W = 1.0
# What a busy machine does to any master in real time: a command expires, the lease ends, an answer is late.
STARVED = ("wrong_state", "no_lease", "no answer from node", "busy", "not_ready")


def correct_readings():
    return [text for power_W in (POWER_W / 2, POWER_W) for text in (f"{SUPPLY_V}", f"{power_W / SUPPLY_V:.5f}")]


class CompareSenses(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        self.simulator = Simulator(folder.name, "bench", "--board", EXAMPLE)
        self.addCleanup(self.simulator.end)
        self.bus = f"socketcand:{self.simulator.port}"

    def supercoil(self, *arguments, **options):
        return subprocess.run([SUPERCOIL, *arguments, "--can", self.bus], capture_output=True, text=True,
                              timeout=DEADLINE_S, **options)

    def doctor(self, answers, *arguments):
        """Repeats when the machine kept a program from running for so long that the board let go of the muscle."""
        for _ in range(TRIES):
            self.supercoil("command", "1", "reset")
            done = self.supercoil("doctor", "--compare-senses", "--power", str(POWER_W), "--config", EXAMPLE,
                                  *arguments, input="".join(f"{answer}\n" for answer in answers))
            if not any(why in done.stderr for why in STARVED):
                return done
        self.fail(f"the machine is too busy: {done.stderr}")

    def sense_gains(self):
        settings = {}
        for line in self.supercoil("setting", "1", "--json").stdout.splitlines():
            setting = json.loads(line)
            settings[setting["setting"]] = setting["value"]
        return settings["supply_gain"], settings["current_gain"], settings["sense_error_ratio"]

    def assert_nothing_changed(self):
        self.assertEqual(self.sense_gains(), (1.0, 1.0, 0.0))
        self.assert_cold()

    def assert_cold(self):
        self.assertRegex(self.supercoil("command", "state").stdout, "node 1: (disarmed|fault)")

    def test_correct_readings_narrow_the_bounds(self):
        done = self.doctor(correct_readings(), "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        supply_gain, current_gain, error_ratio = self.sense_gains()
        self.assertAlmostEqual(supply_gain, 1.0, delta=0.01)
        self.assertAlmostEqual(current_gain, 1.0, delta=0.02)
        self.assertGreaterEqual(error_ratio, 0.0199)
        self.assertLess(error_ratio, 0.06)
        self.assertAlmostEqual(found["error_ratio"], error_ratio, places=5)
        self.assertIn("the true power is 0.9", found["bounds"])
        self.assert_cold()

    def test_a_contradictory_reading_is_refused(self):
        answers = correct_readings()
        answers[3] = f"{1.1 * float(answers[3]):.5f}"
        done = self.doctor(answers)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("refused: out_of_range. This reading contradicts the others", done.stderr)
        self.assert_nothing_changed()

    def test_invalid_readings_are_requested_again_with_the_range(self):
        answers = correct_readings()
        swapped = answers[1]
        done = self.doctor(["twelve", swapped, *answers])
        self.assertEqual(done.returncode, 0, done.stderr)
        for refused in ("twelve", swapped):
            self.assertIn(f"'{refused}' is refused: it must be a number from 10.8 to 13.2", done.stdout)
        done = self.doctor(["", "-12", "1e9", *answers])
        self.assertEqual(done.returncode, 1)
        self.assertIn("no allowed answer in 3 tries: volts at the supply terminals", done.stderr)

    def test_missing_readings_change_nothing(self):
        done = self.doctor(correct_readings()[:2])
        self.assertEqual(done.returncode, 1)
        self.assertIn("no answer: the input has ended", done.stderr)
        self.assert_nothing_changed()

    def test_more_power_than_the_channel_may_have_is_refused(self):
        done = self.supercoil("doctor", "--compare-senses", "--power", "50", "--config", EXAMPLE, input="")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr, f"supercoil: --power 50: {EXAMPLE} allows channel 1 at most 4.5 W (limits.max_W)\n")

    def test_a_channel_that_is_armed_already_is_named_so(self):
        self.supercoil("command", "1", "reset")
        self.supercoil("command", "1", "arm")
        done = self.supercoil("doctor", "--compare-senses", "--config", EXAMPLE, input="")
        self.assertEqual((done.returncode, done.stderr), (1, "supercoil: arm: refused: wrong_state: it is already "
                                                          "armed, or has a fault: reset it first\n"))

    def test_ctrl_c_leaves_the_channel_disarmed(self):
        for _ in range(TRIES):
            self.supercoil("command", "1", "reset")
            with subprocess.Popen(
                    [SUPERCOIL, "doctor", "--compare-senses", "--power", str(POWER_W), "--config", EXAMPLE, "--can",
                     self.bus], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as doctor:
                first = [doctor.stdout.readline(), doctor.stdout.readline()]
                doctor.send_signal(signal.SIGINT)
                _, errors = doctor.communicate(timeout=DEADLINE_S)
            self.assertIn("Ctrl-C ends it at any time", first[0])
            if "interrupted" in errors:
                break
        self.assertIn("interrupted", errors)
        self.assertEqual(doctor.returncode, 1)
        self.assert_nothing_changed()

    def test_a_board_with_another_file_is_not_heated(self):
        other = self.path / "board.toml"
        other.write_text(EXAMPLE.read_text().replace("max_W = 4.5", "max_W = 3.5", 1))
        done = self.supercoil("doctor", "--compare-senses", "--config", other, "--json", input="")
        self.assertEqual(done.returncode, 1, done.stdout)
        why = json.loads(done.stdout)["error"]
        self.assertIn(f"{other}: the board is not running with this file: channel 1: limits.max_W = 3.5 (the board: 4.5)",
                      why)
        self.assertIn(why, done.stderr)
        self.assertNotIn("gets", done.stderr)
        self.assertNotIn("volts", done.stderr)
        self.assert_nothing_changed()

    def test_requires_a_readable_file_and_a_valid_channel(self):
        done = self.supercoil("doctor", "--compare-senses", "--config", "/no/board.toml", "--json")
        self.assertEqual(done.returncode, 2)
        self.assertIn("/no/board.toml", done.stderr)
        self.assertIn("/no/board.toml", json.loads(done.stdout)["error"])
        done = self.supercoil("doctor", "--compare-senses", "--config", EXAMPLE, "--channel", "40", "--json")
        self.assertEqual(done.returncode, 2)
        self.assertIn("has no channel 40", json.loads(done.stdout)["error"])


if __name__ == "__main__":
    unittest.main()
