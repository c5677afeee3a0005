"""The bridge's messages are, byte by byte and hash by hash, those of ROS 2 as an independent library has them."""

import unittest

import numpy as np
from peer import STORES, on_dds

from supercoil.ros import messages, names

OURS = {f"{kind.__idl_typename__}": kind for kind in vars(messages).values()
        if isinstance(kind, type) and hasattr(kind, "__idl_typename__") and kind is not messages.IdlStruct}


def examples(store):
    """Ours, and the same in rosbags' types."""
    made = store.types

    def header(of):
        return of["std_msgs/msg/Header"](of["builtin_interfaces/msg/Time"](1764111000, 999_999_999), "base")
    our_header = messages.Header(messages.Time(1764111000, 999_999_999), "base")
    numbers = [0.0125, -1.5e-300, float("nan")]
    array = np.array(numbers)
    empty = np.array([], dtype=np.float64)
    duration = made["builtin_interfaces/msg/Duration"](3, 500_000_000)
    point = made["trajectory_msgs/msg/JointTrajectoryPoint"](np.array([1.0]), np.array([2.0]), empty, empty, duration)
    yield (messages.JointState(our_header, ["finger", "größe", ""], numbers, [], [1.0]),
           made["sensor_msgs/msg/JointState"](header(made), ["finger", "größe", ""], array, empty, np.array([1.0])))
    yield (messages.JointTrajectory(our_header, ["a"], [messages.JointTrajectoryPoint(
               [1.0], [2.0], [], [], messages.Duration(3, 500_000_000))]),
           made["trajectory_msgs/msg/JointTrajectory"](header(made), ["a"], [point]))
    yield (messages.DiagnosticArray(our_header, [messages.DiagnosticStatus(
               messages.ERROR, "n", "m", "id", [messages.KeyValue("k", "v")]), messages.DiagnosticStatus()]),
           made["diagnostic_msgs/msg/DiagnosticArray"](header(made), [
               made["diagnostic_msgs/msg/DiagnosticStatus"](2, "n", "m", "id", [
                   made["diagnostic_msgs/msg/KeyValue"]("k", "v")]),
               made["diagnostic_msgs/msg/DiagnosticStatus"](0, "", "", "", [])]))
    yield messages.Bool(True), made["std_msgs/msg/Bool"](True)
    yield (messages.TriggerRequest(2**64 - 1, -7, 0), made["std_srvs/srv/Trigger_Request"](2**64 - 1, -7, 0))
    yield (messages.TriggerResponse(5, 7, True, "armed"),
           made["std_srvs/srv/Trigger_Response"](5, 7, True, "armed"))


class Messages(unittest.TestCase):
    def test_serialisation_matches_an_independent_library(self):
        seen = set()
        for release, store in STORES.items():
            for ours, theirs in examples(store):
                name = theirs.__msgtype__
                seen.add(type(ours))
                with self.subTest(release=release, name=name):
                    self.assertEqual(ours.__idl_typename__, on_dds(name))
                    wire = ours.serialize(use_version_2=False)
                    self.assertEqual(wire, bytes(store.serialize_cdr(theirs, name)))
                    again = type(ours).deserialize(wire)
                    self.assertEqual(repr(again), repr(ours))
        self.assertEqual(len(seen), 6)

    def test_type_hashes_match_the_definitions(self):
        self.assertEqual(len(messages.TYPE_HASHES), 4)
        for kind, type_hash in messages.TYPE_HASHES.items():
            package, _, _, own = kind.__idl_typename__.split("::")
            for store in STORES.values():
                self.assertEqual(type_hash, store.hash_rihs01(f"{package}/msg/{own.rstrip('_')}"))

    def test_names_are_resolved(self):
        self.assertEqual(names.resolved("joint_states", "supercoil"), "/joint_states")
        self.assertEqual(names.resolved("~/arm", "hand"), "/hand/arm")
        self.assertEqual(names.topic("/joint_states"), "rt/joint_states")
        self.assertEqual(names.request("/hand/arm"), "rq/hand/armRequest")
        self.assertEqual(names.response("/hand/arm"), "rr/hand/armReply")
        for wrong in ("", "/", "a//b", "1a", "a b", "~a", "a/", "ä"):
            with self.assertRaises(ValueError, msg=wrong):
                names.resolved(wrong, "n")


if __name__ == "__main__":
    unittest.main()
