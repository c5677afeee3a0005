"""supercoil play by the board's own socket: supercoild's threads over a simulated board in real time, without CAN."""

import math
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

from local_board import DEADLINE_S, LocalBoard, Watch, apart_m

SUPERCOIL = os.environ["SUPERCOIL"]
TRIES = 5
REST_M = 0.003
# What a busy machine does to any master in real time.
STARVED = ("the board stopped it", "ran dry", "received another command", "has not started", "not_ready", "busy",
           "out_of_range", "wrong_state", "does not answer")


def motion(folder, of_channels):
    """There and back by 1 mm in 3 s, in part."""
    rows = [[f"{i * 0.02:.3f}", *(f"{REST_M + scale * 0.0005 * (1.0 - math.cos(2.0 * math.pi * i / 150)):.7f}"
                                  for scale in of_channels.values())] for i in range(151)]
    path = pathlib.Path(folder) / "motion.csv"
    path.write_text("\n".join(map(",".join, [["time_s", *(f"{n}:position_m" for n in of_channels)], *rows])) + "\n")
    return path


class LocalPlay(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())
        board = LocalBoard()
        self.addCleanup(board.end)
        self.path = board.path

    def supercoil(self, *arguments):
        return subprocess.run([SUPERCOIL, *arguments, "--socket", self.path], capture_output=True, text=True,
                              timeout=DEADLINE_S)

    def arm(self):
        for channel in ("1", "2"):
            self.supercoil("command", channel, "reset")
            self.supercoil("command", channel, "disarm")
            end = time.monotonic() + DEADLINE_S
            while self.supercoil("command", channel, "arm").returncode:
                self.assertLess(time.monotonic(), end)

    def play(self, *arguments, wanted=None):
        """Also what was seen meanwhile. Repeats when the machine was too busy, unless it says what is wanted."""
        for _ in range(TRIES):
            self.arm()
            with Watch(self.path) as watch:
                done = self.supercoil("play", *arguments)
            if (wanted and wanted in done.stderr) or not any(why in done.stderr for why in STARVED):
                return done, watch.seen
        self.fail(f"the machine is too busy: {done.stderr}")

    def until_state(self, of_channel, wanted, player=None):
        end = time.monotonic() + DEADLINE_S
        while wanted not in self.supercoil("command", "state").stdout.splitlines()[of_channel - 1]:
            self.assertLess(time.monotonic(), end)
            if player and player.poll() is not None:
                return False
        return True

    def test_two_channels_move_in_the_same_ticks(self):
        done, seen = self.play(motion(self.folder, {1: 1.0, 2: 0.5}))
        self.assertEqual(done.returncode, 0, done.stderr)
        apart, way_m = apart_m(seen, REST_M, 2.0)
        self.assertGreater(way_m, 0.0009)
        # In a tick of 5 ms the first goes 5 um; the rows of both may be of two ticks.
        self.assertLess(apart, 1.5e-5)

    def test_one_channel_holds_its_last_row_until_interrupted(self):
        path = pathlib.Path(self.folder) / "one.csv"
        path.write_text("time_s,position_m\n0,0.003\n0.5,0.0031\n1,0.0032\n")
        for _ in range(TRIES):
            self.arm()
            player = subprocess.Popen([SUPERCOIL, "play", path, "--channel", "2", "--settle", "0.2", "--hold",
                                       "--socket", self.path], stderr=subprocess.PIPE, text=True)
            if self.until_state(2, " 0.0032 ", player):
                break
            self.addCleanup(player.stderr.close)
        else:
            self.fail("the machine is too busy")
        player.send_signal(signal.SIGINT)
        self.assertEqual(player.communicate()[1].replace("\r", "").strip(), "")
        self.assertEqual(player.returncode, 0)
        self.assertIn("2 armed rest none", self.supercoil("command", "state").stdout)

    def test_an_infeasible_knot_is_refused_with_its_time(self):
        path = pathlib.Path(self.folder) / "fast.csv"
        path.write_text("time_s,position_m\n0,0.002\n1,0.0022\n1.2,0.02\n1.4,0.02\n")
        why = "channel 1: the knot at 1.000 s: refused: infeasible"
        done, _ = self.play(path, "--settle", "0.2", wanted=why)
        self.assertEqual(done.returncode, 1)
        self.assertIn(why, done.stderr)
        self.assertIn("1 armed rest", self.supercoil("command", "state").stdout)

    def test_requires_armed_muscles_and_the_socket(self):
        done = self.supercoil("play", motion(self.folder, {2: 1.0}))
        self.assertEqual(done.returncode, 1)
        self.assertIn("channel 2: position 0.003000: refused: wrong_state", done.stderr)
        done = self.supercoil("play", motion(self.folder, {3: 1.0}))
        self.assertIn("channel 3: position 0.003000: channel '3': must be 1 to 2", done.stderr)
        self.path = f"{self.folder}/nothing"
        done = self.supercoil("play", motion(self.folder, {1: 1.0}))
        self.assertEqual(done.returncode, 1)
        self.assertIn("is supercoild running?", done.stderr)

    def test_wrong_usage_ends_with_status_2_and_the_reason_alone(self):
        for words, why in ((("command", "3", "arm"), "supercoil: 3 arm: channel '3': must be 1 to 2\n"),
                           (("command", "1", "fly"), "supercoil: 1 fly: 'fly' is not a command; there are: arm, "),
                           (("command", "1", "power", "-1"), "supercoil: 1 power -1: power must be 0 W or more\n"),
                           (("command", "3", "tune", "pi"), "supercoil: 3 tune pi: channel '3': must be 1 to 2\n"),
                           (("command", "3", "position", "5deg"),
                            "supercoil: 3 position 5deg: channel '3': must be 1 to 2\n"),
                           (("tune", "3"), "supercoil: channel '3': must be 1 to 2\n"),
                           (("tune", "3", "proportional_W_per_m=1"), "supercoil: channel '3': must be 1 to 2\n")):
            with self.subTest(words):
                done = self.supercoil(*words)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertEqual(done.stderr[:len(why)], why)

    def test_the_muscle_cools_after_the_player_is_killed(self):
        for _ in range(TRIES):
            self.arm()
            player = subprocess.Popen([SUPERCOIL, "play", motion(self.folder, {1: 1.0}), "--settle", "1", "--socket",
                                       self.path], stderr=subprocess.DEVNULL)
            self.addCleanup(player.wait)
            played = self.until_state(1, "active position", player)
            player.kill()
            if played:
                break
        self.assertTrue(played)
        self.until_state(1, "command_timeout")


if __name__ == "__main__":
    unittest.main()
