"""A simulated joint of two muscles: commanded in degrees, seen from both of its nodes."""

import math
import pathlib
import tempfile
import unittest

import numpy as np
from patience import patient

import supercoil
from supercoil import joints, sync

SCENARIO = """[simulation]
duration_s = 86400.0
[joint]
[operator]
action = "none"
[controller]
kind = "learned_ff"
"""
LEVER_TABLE = supercoil.LeverTable(-30.0, 30.0, (0.012, 0.015, 0.011))
ANGLE_DEG = 10.0


class AgainstASpring(unittest.TestCase):
    def test_it_has_no_other_node(self):
        told = dict.fromkeys(joints.TOLD, math.nan)
        self.assertIsNone(joints.joint_of(3, told))
        told[supercoil.Quantity.joint_lever_m] = 0.015
        self.assertEqual(joints.joint_of(3, told), supercoil.Joint(0.015, None))
        self.assertAlmostEqual(joints.joint_of(3, told).angle_deg(0.00523599), 20.0, places=4)


class OnSimulatedJoint(unittest.TestCase):
    lever = ""

    @classmethod
    def setUpClass(cls):
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        scenario = pathlib.Path(folder, "joint.toml")
        scenario.write_text(SCENARIO.replace("[joint]\n", "[joint]\n" + cls.lever))
        cls.simulation = sync.Simulation(scenario, deadline_s=60.0).start()
        cls.addClassCleanup(cls.simulation.stop)

    def muscle(self, node):
        return sync.Muscle(self.simulation.address, node, deadline_s=60.0)


class Joint(OnSimulatedJoint):
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


class JointWithLeverTable(OnSimulatedJoint):
    lever = "lever_m = [0.012, 0.015, 0.011]\nlever_range_deg = [-30.0, 30.0]\n"

    def test_both_nodes_tell_of_the_table(self):
        for node, way in ((1, 1.0), (2, -1.0)):
            with self.muscle(node) as muscle:
                joint = muscle.joint()
            self.assertAlmostEqual(joint.lever_m, way * 0.015)
            for told, configured in zip(joint.table, LEVER_TABLE, strict=True):
                np.testing.assert_allclose(told, configured, rtol=1e-6)
            # The lever's integral, by hand: 15 mm less 4 mm per 30 degrees.
            arc_m = 0.015 * math.radians(10.0) - 0.5 * 0.004 / math.radians(30.0) * math.radians(10.0) ** 2
            self.assertAlmostEqual(joint.position_m(10.0), way * arc_m, 8)


class Lever(unittest.TestCase):
    def test_the_angle_of_an_arc_is_the_one_that_has_it(self):
        for angle_deg in (-90.0, -30.0, -29.0, -1.0, 0.0, 12.0, 30.0, 31.0, 200.0):
            angle_rad = math.radians(angle_deg)
            self.assertAlmostEqual(LEVER_TABLE.angle_rad(LEVER_TABLE.arc_m(angle_rad)), angle_rad, 9)

    def test_an_arc_is_the_levers_integral(self):
        for angle_deg in (-70.0, -20.0, 20.0, 70.0):
            angles = np.linspace(0.0, math.radians(angle_deg), 20001)
            levers_m = np.interp(angles, np.radians([-30.0, 0.0, 30.0]), LEVER_TABLE.levers_m)
            arc_m = np.sum(0.5 * (levers_m[1:] + levers_m[:-1]) * np.diff(angles))
            self.assertAlmostEqual(LEVER_TABLE.arc_m(math.radians(angle_deg)), arc_m, 9)


if __name__ == "__main__":
    unittest.main()
