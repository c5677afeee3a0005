"""What a session does when a board misbehaves: another version, damaged or no answers, lost leases."""

import asyncio
import math
import threading
import time
import unittest
from unittest import mock

import can
from fake_board import NODE, SESSION, FakeBoard, Leased
from patience import patient_tests

import supercoil
from supercoil import sync
from supercoil.address import open_bus
from supercoil.generated import messages
from supercoil.generated.names import Playback, Refusal, State, When
from supercoil.session import LEASE_LASTS_S


@patient_tests
class Sessions(unittest.TestCase):
    def board(self, obey=None, **status):
        # A bus of its own: virtual buses of one name are one bus.
        self.channel = self.id()
        self.lease = obey or Leased()
        board = FakeBoard(self.channel, self.lease, **status)
        self.addCleanup(board.end)
        return board

    def muscle(self, **options):
        return sync.Muscle(f"virtual:{self.channel}", NODE, deadline_s=60.0, **options)

    def test_a_board_of_another_version_can_only_be_stopped(self):
        board = self.board(version=6)
        with self.assertRaisesRegex(supercoil.VersionMismatchError, "version 6 .* speaks 5"), self.muscle():
            pass
        self.assertEqual(board.commands, [])
        self.assertFalse(sync.discover(f"virtual:{self.channel}", seconds=0.3)[0].can_be_commanded)
        sync.stop(f"virtual:{self.channel}", NODE)
        self.assertEqual([command[:2] for command in board.commands], [("disarm", 0.0)])

    def test_a_missing_node_is_named(self):
        self.board()
        with self.assertRaisesRegex(supercoil.NoAnswerError, "no heartbeat from node 6 on virtual:"), \
                sync.Muscle(f"virtual:{self.channel}", 6):
            pass

    def test_the_lease_is_claimed_with_the_boards_nonce_and_released(self):
        board = self.board()
        with self.muscle() as muscle:
            muscle.set_position(0.01)
        sent = [command[:2] for command in board.commands]
        self.assertEqual(sent[:3], [("lease", 0.0), ("lease", 1234.0), ("position", sent[2][1])])
        self.assertAlmostEqual(sent[2][1], 0.01, 8)
        self.assertEqual(sent[-2:], [("disarm", 0.0), ("lease", -1.0)])
        self.assertEqual(board.commands[2][2], 77)
        counters = [command[3] for command in board.commands]
        self.assertEqual(counters, [(counters[0] + i) % 16 for i in range(len(counters))])

    def test_an_old_heartbeat_does_not_count_as_armed(self):
        board = self.board(state=State.armed)
        probed = threading.Timer(0.3, lambda: board.status.update(probing=0))
        self.addCleanup(probed.cancel)

        def probe(opcode, value, session):
            if opcode == "arm":
                board.status["probing"] = 1  # in the next heartbeat; that it was armed before is the newest one
                probed.start()
            if opcode == "position" and board.status["probing"]:
                return Refusal.busy, 0
            return self.lease(opcode, value, session)
        board.obey = probe
        with self.muscle() as muscle:
            muscle.arm(math.inf)
            muscle.set_position(0.01)

    def test_an_expired_lease_is_claimed_again(self):
        board = self.board()
        with self.muscle() as muscle:
            muscle.set_position(0.01)
            self.lease.leased = False
            muscle.set_position(0.02)
            obeyed = [command[0] for command in board.commands if command[0] != "renew"]
        self.assertIn(["position", "lease", "lease", "position"],
                      [obeyed[i:i + 4] for i in range(len(obeyed))])

    def test_a_lost_frame_is_repeated_once(self):
        self.board()
        with self.muscle() as muscle:
            self.lease.refuse["rest"] = [Refusal.wrong_counter]
            muscle.rest()
            self.lease.refuse["rest"] = [Refusal.wrong_counter] * 2
            with self.assertRaises(supercoil.refusals.WrongCounter):
                muscle.rest()

    def test_tuning_answers_are_matched_by_counter_and_value(self):
        board = self.board()
        with self.muscle() as muscle:
            for _ in range(17):  # every counter
                muscle.prepare(follow_s=1.0)
            self.assertNotIn(0, [counter for *_, counter in board.tuned])
            self.assertEqual({write[:3] for write in board.tuned}, {("all", 1.0, 77), ("follow_s", 1.0, 77)})
            board.refuse_tuning = Refusal.out_of_range
            with self.assertRaises(supercoil.refusals.OutOfRange):
                muscle.prepare()
            board.damage_answers = True
            with self.assertRaises(supercoil.NoAnswerError):
                muscle.prepare()
            board.damage_answers = False

    def played(self, board, refusals=()):
        """Plays three knots; the board answers knots with these refusals first."""
        waiting = list(refusals)

        def answer(message):
            if isinstance(message, messages.Knot):
                return {"refusal": waiting.pop(0) if waiting else 0, "playback": Playback.loaded, "room": 9}
            state = Playback.loaded if message.when == When.at_sync else Playback.ended
            return {"refusal": 0, "playback": state, "room": 9}
        board.playback = answer
        with self.muscle() as muscle:
            muscle.play([0.0, 0.25, 0.5], [0.001, 0.002, 0.003], settle_s=0.0)

    def test_a_lost_knot_is_sent_again(self):
        board = self.board()
        self.played(board, [0, Refusal.wrong_counter])
        knots = [message for message in board.trajectory if isinstance(message, messages.Knot)]
        self.assertEqual([(message.after_s, message.position_m, message.velocity_m_per_s) for message in knots],
                         [(0.0, 0.001, 0.0), (0.25, 0.002, 0.004), (0.25, 0.002, 0.004), (0.25, 0.003, 0.0)])
        start, = (message for message in board.trajectory
                  if isinstance(message, messages.Play) and message.when == When.at_sync)
        self.assertEqual(board.synced[0], start.sync)
        self.assertEqual((start.session, start.after_s), (SESSION, 0.1))
        self.assertIn("rest", [command[0] for command in board.commands])

    def test_a_knot_waits_for_room_on_the_board(self):
        board = self.board()
        self.played(board, [0, Refusal.queue_full, Refusal.queue_full])
        self.assertEqual(sum(isinstance(message, messages.Knot) for message in board.trajectory), 5)

    def test_a_lost_session_ends_a_trajectory(self):
        for refusal, error in ((Refusal.no_lease, supercoil.refusals.NoLease),
                               (Refusal.not_lease_holder, supercoil.refusals.NotLeaseHolder)):
            with self.subTest(refusal):
                board = self.board()
                with self.assertRaisesRegex(error, "the knot at 0.250 s is refused"):
                    self.played(board, [0, refusal])
                self.assertEqual(len(board.trajectory), 2)
                self.assertIn("rest", [command[0] for command in board.commands])
                board.end()

    def test_a_trajectory_that_does_not_start_is_reported(self):
        board = self.board()
        board.playback = lambda _: {"refusal": 0, "playback": Playback.loaded, "room": 9}
        with self.muscle() as muscle, self.assertRaisesRegex(supercoil.PlaybackError, "has not started"):
            muscle.play([0.0, 0.5], [0.001, 0.001], settle_s=0.0)
        self.assertGreater(len(board.synced), 1)
        self.assertEqual(board.synced[1], (board.synced[0] + 1) % 256)

    def test_another_masters_lease_is_respected(self):
        board = self.board(lambda *_: (Refusal.not_lease_holder, 0))
        with self.muscle() as muscle:
            with self.assertRaisesRegex(supercoil.refusals.NotLeaseHolder, "lease is refused"):
                muscle.arm()
            self.assertEqual([command[0] for command in board.commands], ["lease"])

    def test_a_master_that_took_an_expired_lease_is_not_disarmed_at_the_end(self):
        board = self.board()

        async def blocks_its_event_loop(close):
            muscle = await supercoil.Muscle(f"virtual:{self.channel}", NODE, deadline_s=60.0).connect()
            await muscle.set_power(0.5)
            await muscle.rest()
            board.commands.clear()
            board.obey = lambda opcode, *_: (0 if opcode == "disarm" else Refusal.not_lease_holder, 0)
            board.status["leased"] = 1
            end = time.monotonic() + LEASE_LASTS_S
            while time.monotonic() <= end or not muscle.telemetry.status.leased:
                time.sleep(0.01)  # noqa: ASYNC251
            if close:
                await muscle.close()

        for close in (True, False):
            with self.subTest(close=close):
                board.obey = Leased()
                board.status["leased"] = 0
                asyncio.run(blocks_its_event_loop(close))
                self.assertEqual([command[0] for command in board.commands], ["lease"])

    def test_an_old_board_without_leases_is_a_mismatch(self):
        self.board(lambda *_: (Refusal.no_lease, 0))
        with self.muscle() as muscle, self.assertRaises(supercoil.refusals.ProtocolMismatch):
            muscle.arm()

    def test_damaged_answers_count_as_missing(self):
        board = self.board()
        with self.muscle() as muscle:
            board.damage_answers = True
            with self.assertRaisesRegex(supercoil.NoAnswerError, "does not answer"):
                muscle.set_power(1.0)
            board.damage_answers = False
            muscle.set_power(1.0)

    def test_every_refusal_is_raised_by_its_name(self):
        self.board()
        with self.muscle() as muscle:
            for refusal in (Refusal.cause_persists, Refusal.no_edge, Refusal.busy, Refusal.queue_full):
                self.lease.refuse["reset"] = [refusal]
                with self.assertRaises(supercoil.refusals.BY_NUMBER[refusal]) as raised:
                    muscle.reset()
                self.assertIn("reset is refused", str(raised.exception))

    def test_a_refusal_due_to_a_fault_raises_the_fault(self):
        self.board(state=3, fault=30)
        with self.muscle() as muscle:
            self.lease.refuse["position"] = [Refusal.wrong_state]
            with self.assertRaises(supercoil.faults.OverTemperature):
                muscle.set_position(0.01)
            with self.assertRaises(supercoil.faults.OverTemperature):
                muscle.hold(1.0)

    def test_hold_and_move_to_raise_the_refusal_that_ended_the_command(self):
        self.board()
        with self.muscle() as muscle:
            for wait in (lambda: muscle.hold(60.0), lambda: muscle.move_to(0.01)):
                muscle.set_position(0.01)
                self.lease.refuse["renew"] = [Refusal.wrong_state] * 100  # as if another program had disarmed it
                with self.assertRaisesRegex(supercoil.refusals.WrongState, "renew is refused"):
                    wait()
            self.lease.refuse = {}
            muscle.set_position(0.01)
            muscle.hold(0.2)
            muscle.rest()
            muscle.hold(0.2)

    def test_a_board_that_falls_silent_ends_hold(self):
        board = self.board()
        with self.assertRaisesRegex(supercoil.NoAnswerError, "does not answer"), self.muscle() as muscle:
            muscle.set_position(0.01)
            board.obey = lambda *_: None
            muscle.hold(60.0)

    def test_wrong_arguments_are_named_and_nothing_is_sent(self):
        board = self.board()
        with self.assertRaisesRegex(ValueError, "node '5': must be a whole number, 1 to 63"):
            sync.Muscle(f"virtual:{self.channel}", str(NODE))
        muscle = self.muscle()
        for command in (muscle.arm, muscle.disarm, muscle.rest):
            with self.assertRaisesRegex(RuntimeError, "node 5 is not connected: use 'with'"):
                command()
        with muscle:
            for wrong in ("0.01", None, [0.01, 0.02]):
                with self.assertRaisesRegex(TypeError, "position_m is .*; it must be a number"):
                    muscle.set_position(wrong)
            for bad in (math.nan, -math.inf):
                for argument, call in (
                        ("timeout_s", muscle.arm), ("position_m", muscle.set_position), ("power_W", muscle.set_power),
                        ("position_m", muscle.move_to), ("seconds", muscle.hold), ("timeout_s", muscle.identify),
                        ("timeout_s", muscle.calibrate), ("true_position_m", muscle.scale),
                        ("place", muscle.use_controller), ("place", muscle.use_estimator),
                        ("volts", muscle.compare_supply), ("amperes", muscle.compare_current),
                        ("kelvins", muscle.compare_rise),
                        ("tolerance_m", lambda value: muscle.move_to(0.001, tolerance_m=value)),
                        ("timeout_s", lambda value: muscle.move_to(0.001, timeout_s=value)),
                        ("max_power_W", lambda value: muscle.change("max_power_W", value)),
                        ("integral_W_per_m_s", lambda value: muscle.prepare(integral_W_per_m_s=value)),
                        ("position_m", lambda value: sync.cycle([muscle.make_position(value)])),
                        ("settle_s", lambda value: muscle.play([0.0, 1.0], [0.0, 0.0], settle_s=value)),
                        ("seconds", lambda value: sync.discover(f"virtual:{self.channel}", seconds=value)),
                        ("deadline_s", lambda value: sync.Muscle(f"virtual:{self.channel}", NODE, deadline_s=value))):
                    why = f"^{argument} is (nan|-inf); it must be a finite number$"
                    with self.subTest(argument, value=bad), self.assertRaisesRegex(ValueError, why):
                        call(bad)
            for argument, call in (("position_m", muscle.set_position), ("settle_s", lambda value: muscle.play(
                    [0.0, 1.0], [0.0, 0.0], settle_s=value)), ("seconds", lambda value: sync.discover(
                        f"virtual:{self.channel}", seconds=value))):
                with self.assertRaisesRegex(ValueError, f"^{argument} is inf; it must be a finite number$"):
                    call(math.inf)
            for call in (muscle.set_power, lambda value: sync.cycle([muscle.make_power(value)])):
                with self.assertRaisesRegex(ValueError, "power_W is -0.001; it must be 0 or more"):
                    call(-0.001)
            with self.assertRaisesRegex(ValueError, "no setting is called 'max_power_w'; did you mean max_power_W?"):
                muscle.change("max_power_w", 1.0)
            with self.assertRaisesRegex(TypeError, "max_power_W is '1'; it must be a number"):
                muscle.change("max_power_W", "1")
        self.assertEqual(board.commands, [])

    def test_a_python_can_bus_is_used_and_stays_open(self):
        self.board()
        with can.Bus(interface="virtual", channel=self.channel) as bus:
            for _ in range(2):
                with sync.Muscle(bus, NODE) as muscle:
                    muscle.set_power(0.5)

    def test_concurrent_commands_are_all_answered(self):
        board = self.board()

        async def many():
            async with supercoil.Muscle(f"virtual:{self.channel}", NODE) as muscle:
                await asyncio.gather(*(muscle.set_position(i / 1e4) for i in range(100)))
        asyncio.run(many())
        sent = [round(command[1] * 1e4) for command in board.commands if command[0] == "position"]
        self.assertEqual(sent, list(range(100)))

    def test_an_address_is_python_cans_interface_and_channel(self):
        for address, interface, channel in (("can0", "socketcan", "can0"), ("gs_usb:0", "gs_usb", 0),
                                            ("slcan:/dev/ttyACM0", "slcan", "/dev/ttyACM0")):
            with mock.patch("can.Bus") as opened:
                open_bus(address, {"bitrate": 500_000})
            opened.assert_called_once_with(interface=interface, channel=channel, bitrate=500_000)

    def test_an_invalid_bus_is_named(self):
        for address in ("nonsense:0", "socketcand:1", "/nowhere/commands"):
            with self.subTest(address), self.assertRaisesRegex(supercoil.BusError, address.split(":")[0]), \
                    sync.Muscle(address):
                pass
        with self.assertRaisesRegex(supercoil.BusError, r"socketcand:abc: must be socketcand:\[HOST:\]PORT"), \
                sync.Muscle("socketcand:abc"):
            pass
        with self.assertRaises(ValueError):
            sync.Muscle("can0", 64)


if __name__ == "__main__":
    unittest.main()
