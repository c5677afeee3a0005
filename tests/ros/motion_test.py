"""Where a trajectory is at each moment, beside scipy; and which ones are refused."""

import unittest

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from supercoil.ros.messages import Duration, Header, JointTrajectory, JointTrajectoryPoint, Time
from supercoil.ros.motion import Held, Knot, Trajectory, knots_of

NOW_S = 1000.0
WALL_S = 1.7e9  # at the same time
START = Knot(NOW_S, 0.001, 0.0)


def point(after_s, positions, velocities=()):
    whole = int(after_s)
    return JointTrajectoryPoint(list(positions), list(velocities), [], [],
                                Duration(whole, round(1e9 * (after_s - whole))))


def trajectory(*points, begins_s=0.0, names=("finger",)):
    return JointTrajectory(Header(Time(int(begins_s), round(1e9 * (begins_s % 1)))), list(names), list(points))


def there(message, joint=0, sender=True):
    return Trajectory(knots_of(message, joint, START, WALL_S), lambda: sender)


class Motion(unittest.TestCase):
    def test_a_command_holds_until_its_time(self):
        held = Held(0.002, 10.0)
        self.assertEqual((held.at(9.999), held.at(10.0)), (0.002, None))

    def test_with_velocities_it_is_a_cubic_hermite_spline(self):
        times, positions, speeds = [0.0, 0.5, 2.0], [0.002, 0.004, 0.001], [0.0, 0.003, -0.001]
        points = [point(t, [0.0, x], [9.0, v]) for t, x, v in zip(times, positions, speeds, strict=True)]
        motion = there(trajectory(*points, names=("other", "finger")), joint=1)
        spline = CubicHermiteSpline(times, positions, speeds)
        for after_s in np.linspace(0.0, 1.999, 41):
            self.assertAlmostEqual(motion.at(NOW_S + after_s), float(spline(after_s)), delta=1e-15)

    def test_without_velocities_it_is_linear(self):
        motion = there(trajectory(point(1.0, [0.003]), point(3.0, [0.001])))
        for after_s, wanted_m in ((0.0, 0.001), (0.5, 0.002), (1.0, 0.003), (2.0, 0.002), (3.0, 0.001)):
            self.assertAlmostEqual(motion.at(NOW_S + after_s), wanted_m, delta=1e-15)

    def test_from_rest_the_first_cubic_starts_at_zero_velocity(self):
        motion = there(trajectory(point(1.0, [0.003], [0.0])))
        spline = CubicHermiteSpline([0.0, 1.0], [0.001, 0.003], [0.0, 0.0])
        self.assertAlmostEqual(motion.at(NOW_S + 0.3), float(spline(0.3)), delta=1e-15)

    def test_a_trajectory_starts_at_its_time_stamp(self):
        later = there(trajectory(point(1.0, [0.003]), begins_s=WALL_S + 2.0))
        self.assertEqual((later.at(NOW_S), later.at(NOW_S + 1.9)), (0.001, 0.001))
        self.assertAlmostEqual(later.at(NOW_S + 2.5), 0.002, delta=1e-12)
        under_way = there(trajectory(point(0.0, [0.0]), point(2.0, [0.004]), begins_s=WALL_S - 1.0))
        self.assertAlmostEqual(under_way.at(NOW_S), 0.002, delta=1e-12)

    def test_its_end_is_held_while_the_sender_exists(self):
        message = trajectory(point(1.0, [0.003]))
        self.assertEqual(there(message, sender=True).at(NOW_S + 500.0), 0.003)
        self.assertIsNone(there(message, sender=False).at(NOW_S + 1.0))
        self.assertIsNotNone(there(message, sender=False).at(NOW_S + 0.999))

    def test_invalid_trajectories_are_refused_with_the_reason(self):
        for message, why in (
                (trajectory(), "has no points"),
                (trajectory(point(1.0, [])), "points[0].positions has 0 values for 1 joints"),
                (trajectory(point(1.0, [0.0, 0.0])), "points[0].positions has 2 values for 1 joints"),
                (trajectory(point(1.0, [0.0], [0.0, 1.0])), "points[0].velocities has 2 values for 1 joints"),
                (trajectory(point(1.0, [float("nan")])), "points[0].positions[0] is nan"),
                (trajectory(point(1.0, [0.0], [float("inf")])), "points[0].velocities[0] is inf"),
                (trajectory(point(1.0, [0.0]), point(1.0, [0.1])), "points[1].time_from_start is not after the one"),
                (trajectory(point(-1.0, [0.0])), "points[0].time_from_start is -1 s; must be 0 to 600"),
                (trajectory(point(601.0, [0.0])), "must be 0 to 600"),
                (trajectory(point(1.0, [0.0]), begins_s=WALL_S + 61.0), "begins in 61 s; must be at most 60"),
                (trajectory(point(1.0, [0.0]), begins_s=WALL_S - 3.0), "ended 2 s ago")):
            with self.subTest(why), self.assertRaises(ValueError) as refused:
                knots_of(message, 0, START, WALL_S)
            self.assertIn(why, str(refused.exception))


if __name__ == "__main__":
    unittest.main()
