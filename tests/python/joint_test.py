"""A simulated joint of two muscles: commanded in degrees, seen from both of its nodes."""

import math
import pathlib
import tempfile
import unittest

import numpy as np
from patience import patient

import supercoil
from supercoil import codec, joints, messages, sync
from supercoil.generated.names import Part

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
    def test_a_spring_joint_has_no_other_node(self):
        quantities = dict.fromkeys(joints.QUANTITIES, math.nan)
        self.assertIsNone(joints.joint_of(3, quantities))
        quantities[supercoil.Quantity.joint_lever_m] = 0.015
        self.assertEqual(joints.joint_of(3, quantities), supercoil.Joint(0.015, None))
        self.assertAlmostEqual(joints.joint_of(3, quantities).angle_deg(0.00523599), 20.0, places=4)


class Parts(unittest.TestCase):
    """Of Joint, as they come one after the other."""

    def setUp(self):
        self.telemetry = supercoil.Telemetry(1)
        self.time_s = 0.0

    def receive(self, part, **values):
        self.time_s += 1.0
        data = codec.encode(codec.LAYOUTS[messages.JOINT], {"part": part, **values})
        self.telemetry.take(messages.JOINT, self.time_s, data)

    def test_the_newest_frame_merges_all_parts(self):
        self.receive(Part.motion, angle_deg=1.0, reference_deg=20.0, error_deg=math.nan)
        self.receive(Part.antagonist_heat, angle_deg=2.0, antagonist_hottest_C=50.0, antagonist_slack=1)
        joint = self.telemetry.joint
        self.assertEqual((joint.time_s, joint.part), (2.0, Part.antagonist_heat))
        self.assertEqual((joint.angle_deg, joint.reference_deg), (2.0, 20.0))
        self.assertEqual((joint.antagonist_hottest_C, joint.antagonist_slack, joint.agonist_slack), (50.0, True, False))
        self.assertTrue(math.isnan(joint.error_deg) and math.isnan(joint.agonist_hottest_C))

    def test_a_part_replaces_its_previous_value(self):
        for reference_deg, slack in ((20.0, 1), (10.0, 0), (5.0, 1), (math.nan, 0)):
            self.receive(Part.motion, reference_deg=reference_deg, agonist_slack=slack)
            self.receive(Part.effort, effort_W=1.0, agonist_slack=slack)
            np.testing.assert_equal(self.telemetry.joint.reference_deg, reference_deg)


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
    def test_both_nodes_report_the_joint(self):
        with self.muscle(1) as right, self.muscle(2) as left:
            self.assertEqual(right.joint(), supercoil.Joint(0.015, 2))
            self.assertEqual(left.joint(), supercoil.Joint(-0.015, 1))
            self.assertAlmostEqual(left.joint().angle_deg(left.joint().position_m(ANGLE_DEG)), ANGLE_DEG)
            self.assertAlmostEqual(left.joint().position_m(ANGLE_DEG), -right.joint().position_m(ANGLE_DEG))

    @patient
    def test_one_node_reports_the_angle_and_both_heaters(self):
        with self.muscle(1) as right, self.muscle(2) as left:
            if right.state == supercoil.State.fault:
                right.reset()
            right.arm()
            right.move_to(right.joint().position_m(ANGLE_DEG))
            right.hold(0.5)
            joint = right.telemetry.joint
            self.assertAlmostEqual(joint.angle_deg, right.joint().angle_deg(right.position_m), delta=0.3)
            self.assertAlmostEqual(joint.reference_deg, ANGLE_DEG, delta=0.001)
            self.assertAlmostEqual(joint.co_contraction_W, left.telemetry.power.demanded_W, delta=0.01)
            self.assertGreater(joint.agonist_applied_W, 0.0)
            self.assertAlmostEqual(joint.agonist_hottest_C, right.telemetry.temperature.hottest_C, delta=2.0)
            self.assertAlmostEqual(joint.antagonist_hottest_C, left.telemetry.temperature.hottest_C, delta=2.0)
            self.assertAlmostEqual(joint.antagonist_resistance_Ohm, left.telemetry.measurement.resistance_Ohm,
                                   delta=0.2)
            self.assertFalse(any(math.isnan(value) for value in joint))
            with self.assertRaisesRegex(supercoil.NoAnswerError, "node 2 has sent no Joint yet"):
                _ = left.telemetry.joint

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

    def test_both_nodes_report_the_lever_table(self):
        for node, way in ((1, 1.0), (2, -1.0)):
            with self.muscle(node) as muscle:
                joint = muscle.joint()
            self.assertAlmostEqual(joint.lever_m, way * 0.015)
            for reported, configured in zip(joint.table, LEVER_TABLE, strict=True):
                np.testing.assert_allclose(reported, configured, rtol=1e-6)
            # The lever's integral, by hand: 15 mm less 4 mm per 30 degrees.
            arc_m = 0.015 * math.radians(10.0) - 0.5 * 0.004 / math.radians(30.0) * math.radians(10.0) ** 2
            self.assertAlmostEqual(joint.position_m(10.0), way * arc_m, 8)


class Lever(unittest.TestCase):
    def test_angle_inverts_arc(self):
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
