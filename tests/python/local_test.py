"""The board's own socket, against a server that speaks as firmware/apps/supercoild/local_commands.cpp does."""

import asyncio
import math
import pathlib
import re
import socket
import tempfile
import threading
import time
import unittest

from patience import patient_tests

import supercoil
from supercoil import Setting, State, sync
from supercoil.clock import SocketClock
from supercoil.generated.names import Mode, Opcode

ROOT = pathlib.Path(__file__).resolve().parents[2]


class FakeDaemon:
    """Answers each line by answers (line -> text); all else is obeyed. Two channels, of which the second is told."""

    def __init__(self, path):
        self.answers = {"senses": "1 1 1 0\n2 1.02 0.985 0.021\n",
                        "muscle": "1 nan\n2 " + " ".join(map(str, range(14))) + " nan\n"}
        self.identified = ("found", "theta2_uncertain,friction")
        self.waits_s = {}  # before it answers a line
        self.lines = []
        self.tell("disarmed", "rest")
        self._listener = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self._listener.bind(path)
        self._listener.listen()
        threading.Thread(target=self._serve, daemon=True).start()

    def tell(self, state, mode, fault="none", result="none", notes="-"):
        self.answers["state"] = (f"1 disarmed rest none nan nan 0 0 20 21 nan none -\n"
                                 f"2 {state} {mode} {fault} 0.004 0.0035 0.0034 1.25 30.5 41 0.5 {result} {notes}\n")
        self.answers["status"] = f"1 disarmed none -\n2 {state} {fault} -\n"

    def end(self):
        self._listener.close()

    def _serve(self):
        while True:
            try:
                client, _ = self._listener.accept()
            except OSError:
                return
            threading.Thread(target=self._talk, args=(client,), daemon=True).start()

    def _talk(self, client):
        with client:
            while line := client.recv(200).decode():
                answer = self.answers.get(line, "nan" if line.startswith("tuning ") else "ok")
                if line not in ("state", "status"):
                    self.lines.append(line)
                if answer == "ok" and line.split()[1] in ("arm", "disarm", "rest", "position", "identify"):
                    self.tell(*{"arm": ("armed", "rest"), "disarm": ("disarmed", "rest"), "rest": ("armed", "rest"),
                                "position": ("active", "position"),
                                "identify": ("armed", "rest", "none", *self.identified),
                                }[line.split()[1]])
                time.sleep(self.waits_s.get(line, 0.0))
                client.send(answer.encode())


@patient_tests
class Local(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = f"{folder.name}/commands"
        self.daemon = FakeDaemon(self.path)
        self.addCleanup(self.daemon.end)

    def muscle(self):
        return sync.Muscle(self.path, 2, deadline_s=60.0)

    def test_a_channel_works_as_over_can(self):
        with self.muscle() as muscle:
            muscle.arm()
            muscle.move_to(0.0034)
            self.assertEqual((muscle.state, muscle.telemetry.status.mode), (State.active, Mode.position))
            self.assertEqual(muscle.position_m, 0.0034)
            self.assertEqual((muscle.telemetry.tracking.reference_m, muscle.telemetry.tracking.error_m), (0.004, -1e-4))
            self.assertEqual(muscle.telemetry.temperature[1:], (30.5, 41.0))
            self.assertEqual(muscle.telemetry.power.applied_W, 1.25)
        commands = [line for line in self.daemon.lines if line != "2 renew"]
        self.assertEqual(commands, ["2 arm", "2 position 0.0034", "2 disarm"])
        self.assertIn("2 renew", self.daemon.lines)

    def test_a_slack_muscle_is_reported(self):
        for notes, slack in (("- 0 pi slack", 1), ("- 0 pi -", 0), ("-", 0)):
            self.daemon.tell("armed", "rest", notes=notes)
            with self.muscle() as muscle:
                self.assertEqual(muscle.telemetry.status.slack, slack)

    def test_refusals_and_faults_are_named(self):
        with self.muscle() as muscle:
            self.daemon.answers["2 position 1"] = "refused: out_of_range; 0.025 would be obeyed"
            with self.assertRaises(supercoil.refusals.OutOfRange) as raised:
                muscle.set_position(1.0)
            self.assertEqual(raised.exception.nearest, 0.025)
            self.daemon.answers["2 store"] = "refused: not_ready"
            with self.assertRaises(supercoil.refusals.NotReady):
                muscle.store()
            self.daemon.answers["2 power 1"] = "refused: too many commands"
            with self.assertRaises(supercoil.refusals.QueueFull):
                muscle.set_power(1.0)
            self.daemon.tell("fault", "rest", "heater_open")
            with self.assertRaises(supercoil.faults.HeaterOpen):
                muscle.hold(10.0)

    def test_a_failed_identify_names_each_reason_once(self):
        self.daemon.identified = ("too_little_motion", "theta1_kept,too_little_motion")
        with self.muscle() as muscle, self.assertRaises(supercoil.OutcomeError) as raised:
            muscle.identify()
        self.assertRegex(str(raised.exception),
                         r"identify ended: too_little_motion: the muscle moved by less .* maximum power; theta1_kept$")
        self.assertEqual(raised.exception.notes, ("theta1_kept", "too_little_motion"))

    def test_learned_and_known_values_are_available(self):
        with self.muscle() as muscle:
            self.assertEqual(muscle.identify(), (supercoil.Result.found, ("theta2_uncertain", "friction")))
            quantities = muscle.quantities()
            self.assertEqual(quantities[supercoil.Quantity.moving_mass_kg], 4.0)
            self.assertTrue(math.isnan(quantities[supercoil.Quantity.configured_moving_mass_kg]))  # of an older board
            self.assertEqual(muscle.settings(), {Setting.supply_gain: 1.02, Setting.current_gain: 0.985,
                                                 Setting.sense_error_ratio: 0.021})
            with self.assertRaisesRegex(supercoil.SupercoilError, "only over CAN"):
                muscle.change(Setting.max_power_W, 1.0)
            self.daemon.answers["playback"] = "wrong: channel 'playback': must be 1 to 2"  # an older board
            with self.assertRaisesRegex(supercoil.BusError,
                                        "nothing is known about channel 2: channel 'playback'"):
                muscle.play([0.0, 1.0], [0.003, 0.003], settle_s=0.0)

    def test_tuning_reports_the_boards_reason_for_a_refusal(self):
        for of, value in (("in_use", "1500"), ("configured", "2000"), ("stored", "2000"), ("prepared", "1500")):
            self.daemon.answers[f"tuning 2 1 proportional_W_per_m {of}"] = value
            self.daemon.answers[f"tuning 2 1 kind {of}"] = "1"
        with self.muscle() as muscle:
            tuning = muscle.tuning(1)
            self.assertEqual(set(tuning), {"kind", "proportional_W_per_m"})
            self.assertEqual(tuning["kind"].in_use, "pi")
            self.assertEqual(tuning["proportional_W_per_m"], (
                "proportional_W_per_m", "W/m", 1500.0, 2000.0, 2000.0, 1500.0, (0.0, 1e7)))
            self.daemon.lines.clear()
            muscle.tune(1, base="configured", integral_W_per_m_s=900, proportional_W_per_m=1234.56789)
            muscle.store_tuning()
            muscle.forget_tuning()
            self.assertEqual(self.daemon.lines, [
                "prepare 2 1 all configured", "prepare 2 1 proportional_W_per_m 1234.56789",
                "prepare 2 1 integral_W_per_m_s 900.0", "2 tune 1", "2 store tuning", "2 clear tuning"])
            self.daemon.answers["2 tune 0"] = "refused: unsuitable: integral_W_per_m_s is unstable: at most 400"
            with self.assertRaisesRegex(supercoil.refusals.Unsuitable, "at most 400") as raised:
                muscle.take_over()
            self.assertEqual(raised.exception.reason, "integral_W_per_m_s is unstable: at most 400")
            self.daemon.answers["prepare 2 0 follow_s 0.0"] = "refused: out_of_range; 0.02 would be obeyed"
            with self.assertRaisesRegex(supercoil.refusals.OutOfRange, "follow_s = 0.0 is refused") as raised:
                muscle.tune(follow_s=0)
            self.assertEqual(raised.exception.nearest, 0.02)
            self.daemon.answers["tuning 2 0 kind prepared"] = "wrong: 'tuning' is not a command"
            with self.assertRaisesRegex(supercoil.SupercoilError, "not a command"):
                muscle.tuning()

    def test_a_cancelled_command_leaves_no_stale_answer(self):
        self.daemon.waits_s["2 store"] = 0.2
        self.daemon.answers.update({"2 store": "refused: not_ready", "tuning 2 0 kind in_use": "1"})

        async def cancelled():
            async with supercoil.Muscle(self.path, 2, deadline_s=60.0) as muscle:
                storing = asyncio.create_task(muscle.store())
                await asyncio.sleep(0.05)
                storing.cancel()
                with self.assertRaises(asyncio.CancelledError):
                    await storing
                await muscle.rest()
                return (await muscle.tuning())["kind"].in_use
        self.assertEqual(asyncio.run(cancelled()), "pi")

    def test_channels_of_one_board_share_the_start_time(self):
        clock = SocketClock.of(self.path)
        self.assertIs(SocketClock.of(self.path), clock)
        first = clock.next_number()
        self.assertEqual([clock.start_s(first, board_s, 0.1) for board_s in (10.0, 10.02)], [10.1, 10.1])
        self.assertEqual(clock.start_s(clock.next_number(), 20.0, 0.1), 20.1)

    def test_every_command_becomes_a_line_for_the_board(self):
        with self.muscle() as muscle:
            muscle.scale(0.0101)
            muscle.use_controller(1)
            muscle.use_estimator(0)
            muscle.forget()
            muscle.compare_supply(12.1)
            muscle.compare_current(0.45)
            muscle.compare_rise(31.0)
            muscle.renew()
            self.assertEqual(self.daemon.lines[:8], [
                "2 scale 0.0101", "2 controller 1", "2 estimator 0", "2 clear", "2 compare_supply 12.1",
                "2 compare_current 0.45", "2 compare_rise 31", "2 renew"])
        verbs = (ROOT / "firmware" / "core" / "loop" / "command.hpp").read_text()
        known = set(re.findall(r'"(\w+)"', verbs.split("verb_names{")[1].split("}")[0])) | {"clear"}
        self.assertLessEqual({line.split()[1] for line in self.daemon.lines}, known)
        self.assertLessEqual({opcode.name for opcode in Opcode} - {"compare", "claim_of_version_3", "lease"}, known)

    def test_a_daemon_that_ends_also_ends_hold(self):
        with self.assertRaisesRegex(supercoil.BusError, "supercoild has ended"), self.muscle() as muscle:
            muscle.arm()
            muscle.set_position(0.004)
            self.daemon.answers["2 renew"] = ""  # closes the connection
            muscle.hold(60.0)

    def test_stop_disarms_a_channel_and_discover_needs_a_bus(self):
        sync.stop(self.path, 2)
        self.assertEqual(self.daemon.lines, ["2 disarm"])
        with self.assertRaisesRegex(supercoil.BusError, "commands: is the socket of one board"):
            sync.discover(self.path)
        with self.assertRaisesRegex(TypeError, r"address is .*Path\(.*; it must be text, or a bus of python-can"):
            sync.Muscle(pathlib.Path(self.path), 2).connect()

    def test_a_missing_channel_is_named(self):
        with self.assertRaisesRegex(supercoil.BusError, "nothing is known about channel 3"), sync.Muscle(self.path, 3):
            pass


if __name__ == "__main__":
    unittest.main()
