"""python-can with cantools commands the simulated board over socketcand; so does the example."""

import importlib.util
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest

import can
import cantools

import e2e
from live import COMMAND, DEADLINE_S, FROM_BOARD, TRIES, Master, Simulator

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples/python/move_muscle.py"
DBC = ROOT / "firmware/io/can/supercoil.dbc"
TARGET_M = 0.005
OF_NODE_2 = 0x2C2  # its Tracking; the simulated board is node 1


def is_there(master):
    return abs(master.newest["Measurement"]["position_m"] - TARGET_M) < 2e-4


class OnTheBus(unittest.TestCase):
    scenario = "bench"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.simulator = Simulator(folder.name, self.scenario)
        self.addCleanup(self.simulator.end)
        self.master = self.new_master()

    def new_master(self, name=0x1234):
        master = Master(self.simulator.port, name)
        self.addCleanup(master.bus.shutdown)
        return master

    def while_leased(self, request):
        """What request() returns while the master has the lease, which this program loses when it is starved."""
        for _ in range(TRIES):
            self.master.claim()
            session = self.master.session
            answer = request()
            if self.master.claim() == "none" and self.master.session == session:
                return answer
        self.fail("no lease lasted")

    def assert_nothing_but_starved(self):
        """A command may have expired where this program was starved; no other fault may have come."""
        self.assertLessEqual(set(self.master.faults), {"command_timeout"})

    def example_without(self, message):
        """The example, with the protocol from before this message."""
        folder = pathlib.Path(self.simulator.out).with_name("old")
        folder.mkdir()
        (folder / EXAMPLE.name).write_text(EXAMPLE.read_text())
        number = cantools.database.load_file(DBC).get_message_by_name(message).frame_id
        dbc = re.sub(rf"BO_ {number} {message}.*?\n\n", "", DBC.read_text(), flags=re.S)
        (folder / "supercoil.dbc").write_text("".join(line for line in dbc.splitlines(True) if f" {number} " not in line))
        self.assertNotIn(message, [known.name for known in cantools.database.load_file(folder / "supercoil.dbc").messages])
        return folder / EXAMPLE.name

    def assert_it_moves_the_muscle(self, example):
        words = ["interface=socketcand", "host=127.0.0.1", f"port={self.simulator.port}", "channel=can0"]
        for _ in range(TRIES):
            done = subprocess.run([sys.executable, example, *words], capture_output=True, text=True, timeout=DEADLINE_S)
            if done.returncode == 0:
                break
            # Starved: its command expired.
            self.master.receive_next("Status")
            self.assert_nothing_but_starved()
            self.master.steer_until(0.0, lambda m: True)
            self.master.request("disarm")
            self.master.request("lease", -1.0)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = done.stdout.splitlines()
        self.assertEqual(len(lines), 10)
        self.assertRegex(lines[-1], r"^0\.00(49\d*|5(0\d*)?) m, \d+(\.\d+)? °C at most$")
        self.master.receive_until(lambda received: received.message == "Status" and not received.signals["leased"]
                                  and received.signals["state"] == "disarmed")


class Commanded(OnTheBus):
    def end_row_of_damaged(self):
        """Ten ticks in a row with damaged commands are a fault; only a tick with an obeyed one ends the row."""
        for _ in range(2):
            self.master.steer_until(TARGET_M, lambda m: True)

    def test_a_master_moves_the_muscle_until_the_command_expires(self):
        self.master.steer_until(TARGET_M, is_there)
        self.assert_nothing_but_starved()
        self.assertGreater(self.master.newest["Temperature"]["hottest_C"], 35.0)
        self.assertGreater(self.master.newest["Power"]["applied_W"], 0.1)
        obeyed = None
        while obeyed is None or obeyed.signals["refusal"] != "none":
            self.master.steer_until(TARGET_M, lambda m: True)
            obeyed = self.master.request("position", TARGET_M)
        expired = self.master.receive_until(lambda received: received.message == "Emergency")
        self.assertEqual((expired.signals["fault"], expired.signals["state"]), ("command_timeout", "fault"))
        self.assertAlmostEqual(expired.time_s - obeyed.time_s, 0.25, delta=0.02)
        self.assertEqual(self.master.receive_next("Power", 2).signals["applied_W"], 0.0)
        self.assertEqual(self.master.receive_next("Heater", 2).signals["duty"], 0.0)

    def test_a_second_master_is_refused_and_may_stop(self):
        other = self.new_master(0x4321)
        self.assertEqual(self.while_leased(lambda: other.refusal("lease")), "not_lease_holder")
        other.session = 0x5555
        self.assertEqual(self.while_leased(lambda: other.refusal("arm")), "not_lease_holder")
        self.assertEqual(self.master.receive_next("Status").signals["state"], "disarmed")
        self.assertEqual(self.while_leased(lambda: self.master.refusal("arm")), "none")
        self.assertEqual(self.master.receive_next("Status", 2).signals["state"], "armed")
        self.assertEqual(other.refusal("disarm"), "none")
        self.assertEqual(self.master.receive_next("Status", 2).signals["state"], "disarmed")

    def test_settings_are_readable_by_all_and_writable_under_the_lease(self):
        self.assertEqual(self.new_master(0x4321).read_setting("max_power_W")["value"], 4.5)
        self.assertEqual(self.master.write_setting("max_power_W", 2.0)["refusal"], "no_lease")
        answer = self.while_leased(lambda: self.master.write_setting("max_power_W", 2.0))
        self.assertEqual((answer["refusal"], answer["value"]), ("none", 2.0))
        answer = self.while_leased(lambda: self.master.write_setting("status_Hz", 0.0))
        self.assertEqual((answer["refusal"], answer["value"]), ("out_of_range", 10.0))
        self.assertEqual(self.master.read_setting("max_power_W")["value"], 2.0)

    def test_a_frame_of_an_earlier_session_is_refused(self):
        self.assertEqual(self.master.claim(), "none")
        earlier, old = self.master.data("arm"), self.master.session
        self.assertEqual(self.while_leased(lambda: self.master.refusal("lease")), "none")
        self.master.request("lease", -1.0)

        def replayed():
            self.master.send(earlier)
            return self.master.receive_until(lambda received: received.signals.get("opcode") == "arm").signals["refusal"]
        self.assertEqual(replayed(), "no_lease")
        self.master.session = self.master.name
        self.assertEqual(self.while_leased(replayed), "not_lease_holder")
        self.assertNotEqual(self.master.session, old)
        self.assertEqual(self.master.receive_next("Status").signals["state"], "disarmed")

    def test_damaged_commands_are_ignored(self):
        chance = random.Random(20261120)
        self.master.steer_until(TARGET_M, lambda m: True)
        for _ in range(40):
            damaged = int.from_bytes(self.master.data("disarm"), "little")
            for bit in chance.sample(range(64), chance.randint(1, 3)):
                damaged ^= 1 << bit
            self.master.send(damaged.to_bytes(8, "little"))
            self.end_row_of_damaged()
        self.assertNotIn("disarm", {answer["opcode"] for answer in self.master.answers})
        self.assert_nothing_but_starved()

    def test_random_frames_do_not_disturb_control(self):
        def off_track_m(master):
            return abs(master.newest["Tracking"]["error_m"])
        chance = random.Random(20261120)
        noisy = self.new_master()
        foreign = [i for i in range(0x800) if i not in FROM_BOARD]  # two must never send the same identifier
        # The controller still learns when the muscle is there for the first time.
        self.master.steer_until(TARGET_M, lambda m: is_there(m) and off_track_m(m) < 1e-4)
        answered, made, starved = len(self.master.answers), self.master.commands_made, len(self.master.faults)
        for _ in range(50):
            for i in range(200):
                is_command = i % 40 == 0
                noisy.bus.send(can.Message(arbitration_id=COMMAND.frame_id if is_command else chance.choice(foreign),
                                           data=chance.randbytes(8 if is_command else chance.randint(0, 8)),
                                           is_extended_id=False))
            self.end_row_of_damaged()
            if len(self.master.faults) == starved:
                self.assertLess(off_track_m(self.master), 2e-4, self.master.newest)
        self.assert_nothing_but_starved()
        obeyed = [answer for answer in self.master.answers[answered:] if answer["refusal"] == "none"]
        self.assertLessEqual(len(obeyed), self.master.commands_made - made)
        self.assertLessEqual({answer["session"] for answer in obeyed}, {self.master.session, self.master.name})


def imported_example():
    spec = importlib.util.spec_from_file_location("move_muscle", EXAMPLE)
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    return example


class Example(OnTheBus):
    def test_its_checksum_matches_the_protocol(self):
        example = imported_example()
        chance = random.Random(20261120)
        for _ in range(1000):
            identifier, data = chance.randrange(0x800), chance.randbytes(8)
            self.assertEqual(bytes([example.crc(identifier, data)]) + data[1:], e2e.protected(identifier, data))

    def test_it_ignores_frames_of_other_nodes(self):
        # A kernel gives it those that came before it had the filters; here there are none.
        example = imported_example()
        example.bus = self.master.bus
        other = self.new_master().bus
        for _ in range(20):
            other.send(can.Message(arbitration_id=OF_NODE_2, data=bytes(8), is_extended_id=False))
        self.assertNotEqual(example.claim(), 0)

    def test_it_moves_the_muscle_and_releases_it(self):
        self.assert_it_moves_the_muscle(EXAMPLE)

    def test_it_works_without_boot_frames(self):
        old = self.example_without("Boot")
        self.master.receive_next("Boot")
        self.assert_it_moves_the_muscle(old)


class ExampleOnAJoint(OnTheBus):
    scenario = "joint-bench"

    def test_it_works_without_joint_frames(self):
        old = self.example_without("Joint")
        self.master.receive_next("Joint")
        self.assert_it_moves_the_muscle(old)


if __name__ == "__main__":
    unittest.main()
