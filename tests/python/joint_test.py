"""A simulated joint of two muscles: commanded in degrees, seen from both of its nodes."""

import pathlib
import tempfile
import unittest

from patience import patient

import supercoil
from supercoil import sync

SCENARIO = """[simulation]
duration_s = 86400.0
[joint]
[operator]
action = "none"
[controller]
kind = "learned_ff"
"""
ANGLE_DEG = 10.0


class Joint(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        scenario = pathlib.Path(folder, "joint.toml")
        scenario.write_text(SCENARIO)
        cls.simulation = sync.Simulation(scenario, deadline_s=60.0).start()
        cls.addClassCleanup(cls.simulation.stop)

    def muscle(self, node):
        return sync.Muscle(self.simulation.address, node, deadline_s=60.0)

    def test_both_nodes_tell_of_it(self):
        with self.muscle(1) as right, self.muscle(2) as left:
            self.assertEqual(right.joint(), supercoil.Joint(0.015, 2))
            self.assertEqual(left.joint(), supercoil.Joint(-0.015, 1))
            self.assertAlmostEqual(left.joint().angle_deg(left.joint().position_m(ANGLE_DEG)), ANGLE_DEG)
            self.assertAlmostEqual(left.joint().position_m(ANGLE_DEG), -right.joint().position_m(ANGLE_DEG))

    @patient
    def test_it_turns_to_an_angle(self):
        with self.muscle(1) as right, self.muscle(2) as left:
            joint = right.joint()
            if right.state == supercoil.State.fault:
                right.reset()
            right.arm()
            right.move_to(joint.position_m(ANGLE_DEG))
            self.assertAlmostEqual(joint.angle_deg(right.position_m), ANGLE_DEG, delta=1.0)
            self.assertAlmostEqual(left.joint().angle_deg(left.position_m), ANGLE_DEG, delta=1.0)


if __name__ == "__main__":
    unittest.main()
