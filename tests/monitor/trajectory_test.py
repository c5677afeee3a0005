"""Trajectories over the monitor's server: knots with their answers, and that whatever ends heating ends them.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import functools
import time
import unittest

from programs import until
from served import OnServedBoard

FIRST_M = 0.004
STEP_S = 0.04


def knots(count, from_m=FIRST_M, rise_m=0.0, begins=True):
    """A way that rises evenly, from rest at the first one."""
    first = [{"after_s": 0, "position_m": from_m, "velocity_m_per_s": 0}] if begins else []
    ways = range(1, count + 1 - len(first))
    return first + [{"after_s": STEP_S, "position_m": from_m + i * rise_m, "velocity_m_per_s": rise_m / STEP_S} for i in ways]


def unless_it_expires(test):
    """Repeats when the machine stalls for 0.25 s: then the command expires, as it must."""
    @functools.wraps(test)
    def tried(self):
        for _ in range(2):
            try:
                return test(self)
            except AssertionError:
                if self.served.state()[0] != "fault":
                    raise
        return test(self)
    return tried


class Trajectories(OnServedBoard):
    def setUp(self):
        super().setUp()
        self.served = self.serve()

    def play(self, knots=(), start=False):
        status, answer = self.served.post("/api/trajectory", {"node": 1, "knots": list(knots), "start": start})
        self.assertEqual(status, 200, answer)
        return answer

    def hold_first(self):
        served = self.served
        served.command("disarm")
        served.command("reset")
        until(lambda: served.command("arm")[1] == {"refusal": "none"} or served.state()[0] == "armed", 30.0)
        until(lambda: served.command("position", FIRST_M) == (200, {"refusal": "none"}))

    def playback(self):
        """Its state, as for a page that is alive."""
        self.served.post("/api/alive", {"node": 1})
        return self.play()["playback"]

    @unless_it_expires
    def test_it_is_played_and_held_at_its_end(self):
        self.hold_first()
        loaded = self.play(knots(12))
        self.assertEqual([loaded[name] for name in ("refusal", "taken", "playback", "room")], ["none", 12, "loaded", 52])
        self.assertAlmostEqual(loaded["buffered_s"], 11 * STEP_S, 2)
        self.assertEqual(self.play(start=True)["refusal"], "none")
        until(lambda: self.playback() == "ended")
        end_s = time.monotonic() + 0.5
        while time.monotonic() < end_s:
            self.playback()
        self.assertEqual((self.playback(), self.served.state()[0]), ("ended", "active"))

    @unless_it_expires
    def test_an_infeasible_knot_is_refused_and_earlier_ones_stay(self):
        self.hold_first()
        answer = self.play(knots(4) + knots(3, rise_m=0.002, begins=False))
        self.assertEqual((answer["refusal"], answer["taken"], answer["playback"]), ("infeasible", 4, "loaded"))

    @unless_it_expires
    def test_another_command_discards_it(self):
        self.hold_first()
        self.assertEqual(self.play(knots(16), start=True)["refusal"], "none")
        until(lambda: self.playback() == "playing")
        self.served.command("position", 0.003)
        answer = self.play(knots(1, begins=False))
        self.assertEqual((answer["refusal"], answer["taken"], answer["playback"]), ("wrong_state", 0, "empty"))

    def test_it_cools_without_a_live_page(self):
        self.hold_first()
        slow = [{**knot, "after_s": 4} if knot["after_s"] else knot for knot in knots(16)]
        self.assertEqual(self.play(slow, start=True)["refusal"], "none")
        until(lambda: self.served.state()[0] == "fault")
        answer = self.play(knots(2))
        self.assertEqual((answer["refusal"], answer["taken"]), ("wrong_state", 0))

    @unless_it_expires
    def test_stop_ends_it_and_nothing_more_is_sent(self):
        self.hold_first()
        self.assertEqual(self.play(knots(16), start=True)["refusal"], "none")
        self.served.post("/stop", "", self.served.stop_port())
        until(lambda: self.served.state()[0] == "disarmed")
        answer = self.play(knots(1, begins=False))
        self.assertEqual((answer["refusal"], answer["taken"]), ("wrong_state", 0))

    def test_invalid_or_unauthorised_trajectories_are_rejected(self):
        for wrong, why in (({"knots": [{"after_s": 0, "position_m": 9, "velocity_m_per_s": 0}]},
                            "knot 1: position_m is 9; it must be -0.8388607 to 0.8388607"),
                           ({"knots": knots(17)}, "knots is 17 knots; it must be a list of 0 to 16"),
                           ({"start": "yes"}, 'start is "yes"; it must be true or false'),
                           ({"node": 64}, "node must be 1 to 63")):
            self.assertEqual(self.served.post("/api/trajectory", {"node": 1, **wrong}), (400, {"error": why}))
        for wrong in ({"token": ""}, {"token": "0" * 32}, {"origin": "null"}, {"origin": "http://example.org"}):
            self.assertEqual(self.served.post("/api/trajectory", {"node": 1}, **wrong)[0], 403, wrong)


if __name__ == "__main__":
    unittest.main()
