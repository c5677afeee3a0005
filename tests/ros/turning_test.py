"""supercoil-ros before a simulated joint of two muscles, whose lever depends on the angle: in radians."""

import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np
from bridged import OK, WARN, Bridged
from patience import DEADLINE_S
from peer import LOOPBACK

from supercoil import State

SCENARIO = """[simulation]
duration_s = 86400.0
[joint]
lever_m = [0.012, 0.015, 0.011]
lever_range_deg = [-30.0, 30.0]
[operator]
action = "none"
[controller]
kind = "learned_ff"
"""
WANTED_RAD = -0.15


def arc_m(angle_rad):
    """The lever's integral from the angle 0, by hand."""
    return 0.015 * angle_rad + 0.5 * (0.003 if angle_rad < 0.0 else -0.004) / math.radians(30.0) * angle_rad ** 2


class Turning(Bridged):
    joints = ("elbow",)

    @classmethod
    def setUpClass(cls):
        cls.scenario = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()), "joint.toml")
        cls.scenario.write_text(SCENARIO)
        super().setUpClass()

    def reference_m(self):
        return self.observers["elbow"].telemetry.tracking.reference_m

    def state(self):
        """The newest one with a position."""
        def newest():
            known = [state for state in self.states.take() if np.all(np.isfinite(state.position))]
            return known[-1] if known else None
        return self.wait(newest)

    def diagnosed_with(self, of, judge, meanwhile):
        """The diagnosis of it once `judge` accepts its values."""
        def as_wanted():
            diagnosis = self.newest_diagnosis(of)
            return diagnosis if diagnosis and judge({value.key: value.value for value in diagnosis.values}) else None
        return self.wait(as_wanted, meanwhile)

    def test_it_turns_to_an_angle(self):
        self.arm()
        self.wait(lambda: abs(self.reference_m() - arc_m(WANTED_RAD)) < 1e-6, self.again({"elbow": WANTED_RAD}))
        self.wait(lambda: abs(self.state().position[0] - WANTED_RAD) < 0.01, self.again({"elbow": WANTED_RAD}))
        self.assertEqual(list(self.state().name), ["elbow"])
        diagnosis = self.diagnosed_with("elbow", lambda values: all(
            abs(float(values[name]) - WANTED_RAD) < 0.01 for name in ("reference_rad", "position_rad")),
            self.again({"elbow": WANTED_RAD}))
        self.assertEqual((diagnosis.level, diagnosis.message), (OK, f"follows, set point {WANTED_RAD:.6f} rad"))
        diagnosis = self.diagnosed_with("elbow antagonist", lambda values: float(values["applied_W"]) > 0.0,
                                        self.again({"elbow": WANTED_RAD}))
        self.assertEqual((diagnosis.hardware_id, diagnosis.message),
                         (f"{self.simulation.address} node 2", "active, antagonist in the joint of node 1"))

    def test_a_trajectory_is_in_radians(self):
        writer = self.trajectory_writer()
        speed_rad_per_s, lasts_s = -0.1, 8.0
        # A cubic from 0 to 0 that begins and ends with this speed: by hand, so far to either side of it.
        furthest_rad = lasts_s * abs(speed_rad_per_s) / (6.0 * math.sqrt(3.0))

        def send():
            """The references that it had; empty where a command has expired."""
            self.arm()
            self.trajectory(writer, [(0.5, [0.0]), (0.5 + lasts_s, [0.0])], self.joints, velocities=(speed_rad_per_s,))
            references_m, end = [], time.monotonic() + 0.5 + lasts_s
            while time.monotonic() < end:
                if self.observers["elbow"].state == State.fault:
                    return []
                references_m.append(self.reference_m())
                time.sleep(0.01)
            return references_m
        references_m = self.wait(send)
        self.assertAlmostEqual(np.nanmin(references_m), arc_m(-furthest_rad), delta=1e-5)
        self.assertAlmostEqual(np.nanmax(references_m), arc_m(furthest_rad), delta=1e-5)

    def test_out_of_range_positions_are_reported_in_radians(self):
        self.arm()
        diagnosis = self.diagnosis_of("elbow", "rad is in", self.again({"elbow": 1.5}))
        self.assertEqual(diagnosis.level, WARN)
        self.assertIn("1.500000 rad is out of range", diagnosis.message)
        self.diagnosis_of("elbow", "a command of nan rad is ignored", self.again({"elbow": math.nan}))

    def test_named_antagonist_is_not_a_joint(self):
        # A bridge that has commanded nothing yet holds no lease, so another master may.
        self.end_bridge()
        self.start_bridge()
        both = subprocess.Popen(
            [sys.executable, "-m", "supercoil.ros", self.simulation.address, "--joint", "knee=1", "--joint", "back=2",
             "--name", "both", "--states", "both_states", "--domain", str(self.domain)], stderr=subprocess.DEVNULL,
            env={**os.environ, "CYCLONEDDS_URI": LOOPBACK})
        self.addCleanup(both.wait)
        self.addCleanup(both.kill)
        states = self.peer.reader("rt/both_states", "sensor_msgs/msg/JointState")
        self.wait(lambda: ["knee"] in [list(state.name) for state in states.take()])
        diagnosis = self.wait(lambda: (status := self.newest_diagnosis("back")) and "joint of node 1" in status.message
                              and status)
        self.assertEqual(diagnosis.level, OK)
        commands = self.peer.writer("rt/both/joint_commands", "sensor_msgs/msg/JointState")
        diagnosis = self.diagnosis_of("back", "command node 1", lambda: self.command({"back": 0.001}, commands))
        self.assertEqual(diagnosis.level, WARN)
        for verb, done in (("arm", State.armed), ("disarm", State.disarmed)):
            self.assertEqual(self.peer.call(f"/both/{verb}", DEADLINE_S), (True, f"knee: {verb}ed"))
            self.wait(lambda done=done: self.all_are(done))


if __name__ == "__main__":
    unittest.main()
