"""supercoil-ros as a process of its own between simulated boards and peers on DDS, for its tests.

A busy machine may let a command expire: then the muscle is armed again, and what is waited for comes later."""

import contextlib
import os
import subprocess
import sys
import time
import unittest

import numpy as np
from patience import DEADLINE_S, QUICK
from peer import LOOPBACK, Peer, Writer

from supercoil import State, SupercoilError, sync

OK, WARN, ERROR, STALE = range(4)
STOP_TYPE = "std_msgs/msg/Bool"


class Bridged(unittest.TestCase):
    """scenario, options: of the simulation; joints: what the bridge is told, and who observes each."""

    scenario = QUICK
    options = ()
    joints = ()

    @classmethod
    def setUpClass(cls):
        cls.domain = 1 + os.getpid() % 200
        cls.simulation = sync.Simulation(cls.scenario, options=cls.options, deadline_s=1e6).start()
        cls.addClassCleanup(cls.simulation.stop)
        cls.observers = {}
        for node, joint in enumerate(cls.joints, 1):
            cls.observers[joint] = sync.Muscle(cls.simulation.address, node, deadline_s=1e6).connect()
            cls.addClassCleanup(cls.observers[joint].close)
        cls.peer = Peer(cls.domain)
        cls.peers = {"ROS2_JAZZY": cls.peer, "ROS2_HUMBLE": Peer(cls.domain, "ROS2_HUMBLE")}
        cls.states = cls.peer.reader("rt/joint_states", "sensor_msgs/msg/JointState")
        cls.diagnostics = cls.peer.reader("rt/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
        cls.commands = cls.peer.writer("rt/supercoil/joint_commands", "sensor_msgs/msg/JointState")
        cls.start_bridge()
        cls.addClassCleanup(cls.end_bridge)

    @classmethod
    def start_bridge(cls, *words):
        cls.bridge = subprocess.Popen(
            [sys.executable, "-m", "supercoil.ros", cls.simulation.address,
             *(word for node, joint in enumerate(cls.joints, 1) for word in ("--joint", f"{joint}={node}")),
             "--domain", str(cls.domain), *words], env={**os.environ, "CYCLONEDDS_URI": LOOPBACK})

    @classmethod
    def end_bridge(cls):
        cls.bridge.kill()
        cls.bridge.communicate()

    def another_bridge(self, address, name, *words):
        """A bridge beside the one that all tests share, for the joint of that name."""
        bridge = subprocess.Popen(
            [sys.executable, "-m", "supercoil.ros", address, "--name", name, "--states", f"{name}_states", "--domain",
             str(self.domain), *words], env={**os.environ, "CYCLONEDDS_URI": LOOPBACK})
        self.addCleanup(bridge.wait)
        self.addCleanup(bridge.kill)
        return bridge

    def setUp(self):
        """An earlier test leaves nothing behind."""
        self.wait(lambda: self.commands.matched())
        self.stop(False)
        for verb in ("reset", "disarm"):
            self.wait(lambda verb=verb: self.call(verb)[0])
        self.wait(lambda: self.all_are(State.disarmed))

    def wait(self, wanted, meanwhile=lambda: None):
        """Waits until `wanted` returns something true, and returns that."""
        end = time.monotonic() + DEADLINE_S
        while not (seen := wanted()):
            self.assertIsNone(self.bridge.poll(), "the bridge has ended")
            self.assertLess(time.monotonic(), end, "never seen")
            meanwhile()
            time.sleep(0.01)
        return seen

    def all_are(self, state):
        return all(observer.state == state for observer in self.observers.values())

    def call(self, service):
        return self.peer.call(f"/supercoil/{service}", DEADLINE_S)

    def arm(self):
        self.wait(lambda: (self.call("reset"), self.call("arm"))[1][0])
        self.wait(lambda: not self.all_are(State.disarmed))

    def command(self, positions_m, writer=None):
        empty = np.array([], dtype=np.float64)
        (writer or self.commands).write(self.peer.message(
            "sensor_msgs/msg/JointState", self.peer.header(), list(positions_m),
            np.array(list(positions_m.values()), dtype=np.float64), empty, empty))

    def again(self, positions_m):
        """Sends it, now and after a command that expired."""
        def once():
            if any(observer.state in (State.fault, State.disarmed) for observer in self.observers.values()):
                self.arm()
            self.command(positions_m)
        return once

    def stop(self, stop, reliable=True):
        """Sends it until it is diagnosed: a bridge that has just begun may not hear the first of them."""
        writer = self.peer.writer("rt/supercoil/emergency_stop", STOP_TYPE, reliable)
        self.wait(writer.matched)
        self.wait(lambda: self.diagnosed("emergency stop") == (ERROR if stop else OK),
                  lambda: writer.write(self.peer.message(STOP_TYPE, stop)))

    def try_to_arm(self, other):
        with contextlib.suppress(SupercoilError):  # it may be disarmed before it is told that it is armed
            other.arm()

    def newest_diagnosis(self, of):
        """The newest diagnosis of it; None: nothing new."""
        found = [status for array in self.diagnostics.take() for status in array.status
                 if status.name == f"supercoil: {of}"]
        return found[-1] if found else None

    def diagnosed(self, of):
        diagnosis = self.newest_diagnosis(of)
        return diagnosis.level if diagnosis else None

    def diagnosis_of(self, joint, text, meanwhile):
        return self.wait(lambda: (status := self.newest_diagnosis(joint)) and text in status.message and status,
                         meanwhile)

    def position_m(self, joint):
        return self.observers[joint].position_m

    def near(self, joint, position_m):
        return abs(self.position_m(joint) - position_m) < 2e-4

    def trajectory(self, writer, points, names=("finger",), velocities=(), begins_s=0.0):
        empty = np.array([], dtype=np.float64)

        def duration(seconds):
            return self.peer.message("builtin_interfaces/msg/Duration", int(seconds), int(1e9 * (seconds % 1)))
        writer.write(self.peer.message(
            "trajectory_msgs/msg/JointTrajectory", self.peer.header(begins_s), list(names), [
                self.peer.message("trajectory_msgs/msg/JointTrajectoryPoint", np.array(positions, dtype=np.float64),
                                  np.array(velocities, dtype=np.float64), empty, empty, duration(after_s))
                for after_s, positions in points]))

    def trajectory_writer(self):
        """One that ends with its last reference."""
        kind = "trajectory_msgs/msg/JointTrajectory"
        writer = Writer(self.peer, "rt/supercoil/joint_trajectory", kind, reliable=True)
        self.wait(writer.matched)
        return writer
