"""A trajectory's columns become its knots, and what is wrong with them is named with its row."""

import math
import unittest

import numpy as np
import pandas as pd

from supercoil import sync
from supercoil.knots import Knot, knots_of


class Knots(unittest.TestCase):
    def test_columns_become_knots_at_whole_milliseconds(self):
        knots = knots_of([10.0, 10.5004, 11.0], [0.001, 0.002, 0.003], [0.0, 0.002, 0.0])
        self.assertEqual(knots, ((10.0, 0.0, 0.001, 0.0), (10.5004, 0.5, 0.002, 0.002), (11.0, 0.5, 0.003, 0.0)))
        self.assertIsInstance(knots[0], Knot)

    def test_rounding_to_milliseconds_does_not_accumulate(self):
        times_s = np.arange(3001) / 3000.0
        times_s = times_s * 3.5  # 1.1667 ms apart
        knots = knots_of(times_s, np.zeros(3001))
        self.assertAlmostEqual(sum(knot.after_s for knot in knots), 3.5, 9)

    def test_missing_velocities_follow_a_parabola_through_three_rows(self):
        times_s = np.array([0.0, 0.2, 0.5, 0.9, 1.0])
        knots = knots_of(times_s, 0.01 * times_s ** 2)
        for row in (1, 2, 3):
            self.assertAlmostEqual(knots[row].velocity_m_per_s, 0.02 * times_s[row], 12)
        self.assertEqual((knots[0].velocity_m_per_s, knots[-1].velocity_m_per_s), (0.0, 0.0))

    def test_lists_arrays_and_table_columns_are_equivalent(self):
        times_s, positions_m = [0.0, 0.5, 1.0], [0.001, 0.002, 0.001]
        table = pd.DataFrame({"time_s": times_s, "position_m": positions_m}, index=[7, 8, 9])
        wanted = knots_of(times_s, positions_m)
        self.assertEqual(knots_of(np.array(times_s), tuple(positions_m)), wanted)
        self.assertEqual(knots_of(table["time_s"], table["position_m"]), wanted)
        self.assertEqual(knots_of(iter(times_s), iter(positions_m)), wanted)

    def test_an_end_at_rest_up_to_rounding_is_accepted(self):
        times_s = np.linspace(0.0, 1.0, 51)
        velocities = 0.001 * np.sin(2.0 * np.pi * times_s)
        self.assertNotEqual(velocities[-1], 0.0)
        knots_of(times_s, 0.002 - 0.001 / (2.0 * np.pi) * np.cos(2.0 * np.pi * times_s), velocities)

    def test_errors_name_the_row(self):
        for columns, why in (
                (([], []), "at least 2 rows, not 0"),
                (([0.0], [0.0]), "at least 2 rows, not 1"),
                (([0.0, 1.0], [0.0]), "positions_m has 1 rows and times_s has 2"),
                (([0.0, 1.0], [0.0, 0.0], [0.0]), "velocities_m_per_s has 1 rows and times_s has 2"),
                ((np.zeros((2, 2)), [0.0, 0.0]), r"times_s: must be one column.* \(2, 2\)"),
                (([0.0, 1.0], [[0.0], [0.0]]), r"row 0: positions_m is \[0.0\]; it must be a finite number"),
                (([0.0, 1.0], [0.0, "1 mm"]), "row 1: positions_m is '1 mm'; it must be a finite number"),
                (([0.0, math.nan], [0.0, 0.0]), "row 1: times_s is nan; it must be a finite number"),
                (([0.0, 1.0], [0.0, None]), "row 1: positions_m is None"),
                (([0.0, 1.0], [0.0, 0.9]), "row 1: positions_m is 0.9; it must be -0.8388607 to 0.8388607"),
                (([0.0, 1.0, 1.0], [0.0] * 3), "row 2: times_s is 0 s after the row before; it must be 0.001 to 4.094"),
                (([0.0, 1.0, 0.5], [0.0] * 3), "row 2: times_s is -0.5 s after the row before"),
                (([0.0, 4.096], [0.0] * 2), "row 1: times_s is 4.096 s after the row before"),
                (([0.0, 1.0, 2.0], [0.0] * 3, [0.0, -0.4, 0.0]), "row 1: velocities_m_per_s is -0.4; it must be "),
                (([0.0, 0.1, 0.2], [0.0, 0.1, 0.2]), "row 1: the velocity between its neighbours, in m/s, is 1; "),
                (([0.0, 1.0], [0.0] * 2, [0.001, 0.0]), "row 0: velocities_m_per_s is 0.001; the first and the last"),
                (([0.0, 1.0], [0.0] * 2, [0.0, 1e-5]), "row 1: velocities_m_per_s is 1e-05; the first and the last")):
            with self.subTest(why), self.assertRaisesRegex(ValueError, why):
                knots_of(*columns)

    def test_motions_are_checked_before_sending(self):
        muscle = sync.Muscle("can0", 1)  # is not connected
        with self.assertRaisesRegex(ValueError, "row 1"):
            muscle.play([0.0, 0.0], [0.0, 0.0])
        motion = muscle.make_motion([0.0, 1.0], [0.0, 0.0])
        for motions, options, why in (([motion, motion], {}, "a muscle has two motions"),
                                      ([motion], {"settle_s": -1.0}, "settle_s is -1; it must be 0 or more"),
                                      ([motion], {"settle_s": math.nan}, "settle_s is nan")):
            with self.subTest(why), self.assertRaisesRegex(ValueError, why):
                sync.play(motions, **options)
        with self.assertRaisesRegex(RuntimeError, "node 1 is not connected"):
            sync.play([motion])


if __name__ == "__main__":
    unittest.main()
