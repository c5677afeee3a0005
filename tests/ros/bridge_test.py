"""supercoil-ros as a process of its own between two simulated boards and peers on DDS."""

import contextlib
import os
import signal
import time
import unittest

import numpy as np
from bridged import ERROR, STALE, STOP_TYPE, WARN, Bridged
from patience import DEADLINE_S, QUICK, TRIES

from supercoil import Fault, State, messages, sync

JOINTS = ("finger", "thumb")


class Live(Bridged):
    options = ("--nodes", "2")
    joints = JOINTS

    def test_states_match_the_boards(self):
        state = self.wait(lambda: next((one for one in self.states.take() if np.all(np.isfinite(one.position))), None))
        self.assertEqual(list(state.name), list(JOINTS))
        self.assertEqual((len(state.velocity), len(state.effort)), (0, 0))
        for joint, position_m in zip(JOINTS, state.position, strict=True):
            self.assertAlmostEqual(position_m, self.position_m(joint), delta=1e-4)
        self.assertLess(abs(state.header.stamp.sec - time.time()), 60.0)

    def test_humble_and_jazzy_read_the_messages(self):
        for peer in self.peers.values():
            states = peer.reader("rt/joint_states", "sensor_msgs/msg/JointState")
            diagnostics = peer.reader("rt/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
            self.assertEqual(list(self.wait(states.take)[-1].name), list(JOINTS))
            self.assertTrue(self.wait(diagnostics.take)[-1].status)

    def test_publishers_announce_their_type_hash(self):
        publication = self.states.dds.get_matched_publications()[0]
        data = self.states.dds.get_matched_publication_data(publication)
        self.assertIn(b"typehash=RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e;",
                      [policy.data for policy in data.qos if type(policy).__name__ == "Userdata"])

    def test_a_command_moves_an_armed_muscle_until_it_expires(self):
        self.arm()
        wanted = {"finger": 0.001, "somebody_elses": 5.0, "thumb": 0.0015}
        self.wait(lambda: self.near("finger", 0.001) and self.near("thumb", 0.0015), self.again(wanted))
        # Silence: it rests, and stays armed.
        self.wait(lambda: all(observer.state in (State.armed, State.fault) for observer in self.observers.values()))

    def test_refusals_are_diagnosed(self):
        diagnosis = self.diagnosis_of("finger", "is disarmed: it cannot move", lambda: self.command({"finger": 0.001}))
        self.assertEqual((diagnosis.level, diagnosis.hardware_id), (WARN, f"{self.simulation.address} node 1"))
        self.assertEqual({value.key: value.value for value in diagnosis.values}["state"], "disarmed")
        self.arm()
        # As a controller streams it: ten in a row would be a fault on the board.
        self.diagnosis_of("thumb", "m is in", self.again({"thumb": 3.0}))
        self.diagnosis_of("thumb", "a command of nan m is ignored", self.again({"thumb": float("nan")}))
        self.assertIn(self.observers["thumb"].fault, (Fault.none, Fault.command_timeout))
        empty = np.array([], dtype=np.float64)
        uneven = self.peer.message("sensor_msgs/msg/JointState", self.peer.header(), ["finger", "thumb"],
                                   np.array([0.001]), empty, empty)
        self.diagnosis_of("thumb", "a command has 1 positions for 2 names", lambda: self.commands.write(uneven))

    def test_a_moving_muscle_rests_after_an_invalid_command(self):
        self.arm()
        self.wait(lambda: self.observers["thumb"].state == State.active, self.again({"thumb": 0.001}))
        self.wait(lambda: self.observers["thumb"].state != State.active, self.again({"thumb": -1.0}))

    def test_a_trajectory_is_followed_and_held_while_its_sender_exists(self):
        writers = [self.trajectory_writer()]

        def send():
            self.arm()
            self.trajectory(writers[0], [(1.0, [0.001, 0.0005]), (3.0, [0.002, 0.001])], JOINTS, velocities=(0.0, 0.0))
            end = time.monotonic() + DEADLINE_S / 3
            while time.monotonic() < end:  # until it is there, or a command has expired
                if self.near("finger", 0.002) and self.near("thumb", 0.001):
                    return True
                if State.fault in [observer.state for observer in self.observers.values()]:
                    return False
                time.sleep(0.02)
            return False
        self.wait(send)
        self.assertAlmostEqual(self.observers["finger"].telemetry.tracking.reference_m, 0.002, delta=1e-6)
        writers.clear()  # as when a program ends
        self.wait(lambda: all(observer.state in (State.armed, State.fault) for observer in self.observers.values()))

    def test_an_invalid_trajectory_is_refused_entirely(self):
        writer = self.trajectory_writer()
        self.arm()
        for points, names, why in (
                ([(1.0, [0.001, 0.001])], ("finger", "toe"), "no joint is called 'toe'; there are finger, thumb"),
                ([(1.0, [0.001, 0.001])], ("finger", "finger"), "names finger twice"),
                ([(1.0, [0.001, float("nan")])], ("finger", "thumb"), "points[0].positions[1] is nan"),
                ([(1.0, [0.001]), (0.5, [0.002])], ("finger",), "points[1].time_from_start is not after"),
                ([(1.0, [float("inf")])], ("finger",), "points[0].positions[0] is inf"),
                ([], ("finger",), "has no points")):
            diagnosis = self.diagnosis_of("finger", why,
                                          lambda points=points, names=names: self.trajectory(writer, points, names))
            self.assertEqual(diagnosis.level, WARN)
            self.assertNotIn(State.active, [one.state for one in self.observers.values()], why)

    def test_an_emergency_stop_disarms_all_until_released(self):
        for reliable in (True, False):
            self.arm()
            self.wait(lambda: self.all_are(State.active), self.again({"finger": 0.001, "thumb": 0.001}))
            self.stop(True, reliable)
            self.wait(lambda: all(one.state in (State.disarmed, State.fault) for one in self.observers.values()))
            self.command({"finger": 0.001, "thumb": 0.001})
            self.assertEqual(self.call("arm"), (False, "the emergency stop is set; publish false on it first"))
            self.stop(False)
            self.assertNotIn(State.active, [one.state for one in self.observers.values()])

    def test_the_emergency_stop_disarms_what_others_arm(self):
        # A bridge that has commanded nothing yet holds no lease, so others may.
        self.end_bridge()
        self.start_bridge()
        self.wait(lambda: self.commands.matched())
        self.stop(True)
        other = sync.Muscle(self.simulation.address, 2, deadline_s=1e6)
        with other, other.record(messages.Status) as recording:
            # It was armed, if only for a heartbeat, and is not any more.
            self.wait(lambda: State.armed in [message.state for message in recording.of(messages.Status)],
                      lambda: self.try_to_arm(other))
            self.wait(lambda: other.state == State.disarmed)
        self.stop(False)

    def test_a_briefly_set_emergency_stop_still_disarms(self):
        writer = self.peer.writer("rt/supercoil/emergency_stop", STOP_TYPE)
        self.wait(lambda: writer.matched() == 2)
        self.wait(lambda: self.all_are(State.active), self.again({"finger": 0.001, "thumb": 0.001}))
        for stop in (True, False):
            writer.write(self.peer.message(STOP_TYPE, stop))
        self.wait(lambda: all(one.state in (State.disarmed, State.fault) for one in self.observers.values()))

    def test_each_joint_is_armed_and_disarmed_separately(self):
        self.wait(lambda: self.call("thumb/arm")[0])
        self.wait(lambda: self.observers["thumb"].state == State.armed)
        self.assertEqual(self.observers["finger"].state, State.disarmed)
        self.assertEqual(self.call("thumb/disarm"), (True, "thumb: disarmed"))
        self.assertEqual(self.call("thumb/reset"), (True, "thumb: has no fault"))

    def test_damaged_messages_are_ignored(self):
        for data in (b"", b"\0\1\0\0", b"\0\1\0\0" + b"\xff" * 40, os.urandom(200)):
            with contextlib.suppress(Exception):  # Cyclone itself refuses to send some of it
                self.commands.write_bytes(data)
        self.arm()
        self.wait(lambda: self.near("finger", 0.001), self.again({"finger": 0.001, "thumb": 0.0005}))

    def test_muscles_cool_when_the_bridge_hangs_or_dies(self):
        for number in (signal.SIGSTOP, signal.SIGKILL):
            self.arm()
            self.wait(lambda: self.all_are(State.active), self.again({"finger": 0.001, "thumb": 0.001}))
            self.bridge.send_signal(number)
            end = time.monotonic() + DEADLINE_S
            while any(one.state == State.active for one in self.observers.values()):
                self.assertLess(time.monotonic(), end, "still heats")
                time.sleep(0.01)
            # A muscle that heated until then has the fault; one whose command had ended rests.
            self.assertTrue({one.fault for one in self.observers.values()} <= {Fault.command_timeout, Fault.none})
            if number == signal.SIGSTOP:
                self.bridge.send_signal(signal.SIGCONT)
        self.end_bridge()
        self.start_bridge()

    def test_a_fault_is_diagnosed_until_it_is_reset(self):
        self.arm()
        self.wait(lambda: self.all_are(State.active), self.again({"finger": 0.001, "thumb": 0.001}))
        self.bridge.send_signal(signal.SIGSTOP)
        self.wait(lambda: Fault.command_timeout in [one.fault for one in self.observers.values()])
        self.bridge.send_signal(signal.SIGCONT)
        in_fault = next(joint for joint, one in self.observers.items() if one.fault != Fault.none)
        diagnosis = self.wait(lambda: (status := self.newest_diagnosis(in_fault)) and status.level == ERROR and status)
        self.assertIn("fault command_timeout: ", diagnosis.message)
        self.wait(lambda: self.call(f"{in_fault}/reset")[0])
        self.wait(lambda: self.observers[in_fault].fault == Fault.none)

    def test_a_very_short_command_timeout_leaves_nothing_heated(self):
        self.end_bridge()
        self.start_bridge("--command-timeout", "0.05")
        self.wait(lambda: self.commands.matched())
        self.arm()
        for _ in range(20):  # before a heartbeat tells that it is active, and after
            self.command({"finger": 0.001})
            time.sleep(0.23)
            end = time.monotonic() + DEADLINE_S / 10
            while self.observers["finger"].state == State.active:
                self.assertLess(time.monotonic(), end, "it is held by nobody's command")
                time.sleep(0.01)
        self.end_bridge()
        self.start_bridge()

    def test_it_exits_even_if_its_bus_ends_first(self):
        with sync.Simulation(QUICK, deadline_s=1e6) as alone:
            bridge = self.another_bridge(alone.address, "last", "--joint", "last=1", "--arm")
            commands = self.peer.writer("rt/last/joint_commands", "sensor_msgs/msg/JointState")
            self.wait(lambda: alone.muscle.state == State.active, lambda: self.command({"last": 0.001}, commands))
        bridge.send_signal(signal.SIGTERM)
        self.assertEqual(bridge.wait(DEADLINE_S), 0)

    def test_a_silent_board_is_stale_until_it_returns(self):
        with sync.Simulation(QUICK, deadline_s=1e6) as alone:
            bridge = self.another_bridge(alone.address, "mute", "--joint", "mute=1", "--arm")

            def seen(wanted, meanwhile=lambda: None):
                self.wait(lambda: self.assertIsNone(bridge.poll(), "it has ended") or wanted(), meanwhile)
            commands = self.peer.writer("rt/mute/joint_commands", "sensor_msgs/msg/JointState")
            seen(lambda: alone.muscle.state == State.active, lambda: self.command({"mute": 0.001}, commands))
            seen(lambda: self.diagnosed("mute") not in (None, STALE))
            board = alone._simulation._process
            self.addCleanup(board.send_signal, signal.SIGCONT)
            board.send_signal(signal.SIGSTOP)
            seen(lambda: self.diagnosed("mute") == STALE)
            board.send_signal(signal.SIGCONT)
            seen(lambda: self.diagnosed("mute") not in (None, STALE))

    def test_it_disarms_on_exit(self):
        self.arm()
        self.wait(lambda: self.all_are(State.active), self.again({"finger": 0.001, "thumb": 0.001}))
        self.bridge.send_signal(signal.SIGTERM)
        self.assertEqual(self.bridge.wait(DEADLINE_S), 0)
        end = time.monotonic() + DEADLINE_S
        # Only a machine that was stopped itself lets a command expire before it is disarmed.
        while not all(one.state == State.disarmed or one.fault == Fault.command_timeout
                      for one in self.observers.values()):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)
        self.assertIn(State.disarmed, [one.state for one in self.observers.values()])
        # It arms without a service; once, which fails where a busy machine keeps the boards silent meanwhile.
        self.assertTrue(any(self.starts_armed() for _ in range(TRIES)))
        self.start_bridge()

    def starts_armed(self):
        self.start_bridge("--arm")
        end = time.monotonic() + DEADLINE_S / TRIES
        armed = False
        while not armed and time.monotonic() < end:
            armed = self.all_are(State.armed) or State.fault in [one.state for one in self.observers.values()]
            time.sleep(0.01)
        self.end_bridge()
        return armed

    def test_a_missing_board_is_stale(self):
        self.another_bridge(self.simulation.address, "other", "--joint", "ghost=9")
        diagnosis = self.wait(lambda: next((status for array in self.diagnostics.take() for status in array.status
                                            if status.name == "supercoil: ghost"
                                            and "heartbeat" in status.message), None))
        self.assertEqual(diagnosis.level, STALE)
        self.assertIn("no heartbeat from node 9", diagnosis.message)
        states = self.peer.reader("rt/other_states", "sensor_msgs/msg/JointState")
        self.assertTrue(np.isnan(self.wait(states.take)[-1].position[0]))


if __name__ == "__main__":
    unittest.main()
