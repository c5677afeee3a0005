"""The board's own socket, with the threads of supercoild and a simulated board of two channels behind it."""

import time
import unittest

from local_board import DEADLINE_S, LocalBoard, Watch, apart_m
from patience import patient_tests

import supercoil
from supercoil import State, sync

REST_M = 0.003
TIMES_S = [0.1 * i for i in range(21)]


def there_and_back_m(scale):
    """In 2 s."""
    return [REST_M + scale * (10 - abs(i - 10)) * 5e-5 for i in range(21)]


@patient_tests
class Local(unittest.TestCase):
    def setUp(self):
        board = LocalBoard()
        self.addCleanup(board.end)
        self.path = board.path

    def muscle(self, channel):
        return sync.Muscle(self.path, channel, deadline_s=DEADLINE_S)

    def test_commands_and_telemetry_work(self):
        with self.muscle(1) as muscle:
            self.assertEqual(muscle.state, State.disarmed)
            muscle.arm()
            muscle.move_to(0.002, tolerance_m=0.001)
            self.assertLess(abs(muscle.position_m - 0.002), 0.001)
            self.assertEqual(muscle.telemetry.status.fault, supercoil.Fault.none)
            with self.assertRaises(supercoil.refusals.OutOfRange) as refused:
                muscle.set_position(1.0)
            self.assertAlmostEqual(refused.exception.nearest, 0.025)
            muscle.tune(proportional_W_per_m=321.5)
            self.assertEqual(muscle.tuning()["proportional_W_per_m"].in_use, 321.5)
            self.assertEqual(muscle.quantities()[supercoil.Quantity.moving_mass_kg], 0.09)
            muscle.disarm()
            self.assertEqual(muscle.state, State.disarmed)

    def test_two_channels_play_in_step(self):
        with self.muscle(1) as one, self.muscle(2) as two:
            for muscle in (one, two):
                muscle.arm()
            with Watch(self.path) as watch:
                sync.play([one.make_motion(TIMES_S, there_and_back_m(1.0)),
                           two.make_motion(TIMES_S, there_and_back_m(0.5))], settle_s=0.2, hold=True)
            self.assertEqual((one.state, two.state), (State.active, State.active))
        apart, way_m = apart_m(watch.seen, REST_M, 2.0)
        self.assertGreater(way_m, 0.00045)
        # In a tick of 5 ms the first goes 3 um; the rows of both may be of two ticks.
        self.assertLess(apart, 1e-5)

    def test_an_infeasible_knot_is_refused_with_its_time(self):
        with self.muscle(2) as muscle:
            muscle.arm()
            with self.assertRaises(supercoil.refusals.Infeasible) as refused:
                muscle.play([0.0, 1.0, 1.2, 1.4], [0.002, 0.0022, 0.02, 0.02], settle_s=0.1)
            self.assertEqual(refused.exception.time_s, 1.0)
            end = time.monotonic() + DEADLINE_S
            while muscle.state == State.active:
                self.assertLess(time.monotonic(), end)
                muscle.hold(0.05)


if __name__ == "__main__":
    unittest.main()
