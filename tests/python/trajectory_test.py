"""Two simulated boards on one bus play trajectories, alone and in step."""

import asyncio
import time
import unittest
from unittest import mock

import numpy as np
from patience import DEADLINE_S, QUICK, patient

import supercoil
from supercoil import State, messages, sync
from supercoil.generated.names import Playback
from supercoil.link import CanLink

NODES = (1, 2)
LENGTH_S = 3.0
TIMES_S = np.linspace(0.0, LENGTH_S, 151)
FIRST_M = 0.003
# In a tick of 10 ms the reference moves 10 um at most.
NEAR_M = 3e-5


def way(times_s, scale=1.0):
    """There and back, by 1 mm."""
    return FIRST_M + scale * 0.0005 * (1.0 - np.cos(2.0 * np.pi * times_s / LENGTH_S))


def references(recording):
    """By the board's clock: times, positions."""
    tracking = recording.arrays("Tracking")
    known = np.isfinite(tracking["reference_m"])
    return tracking["time_s"][known], tracking["reference_m"][known]


def rising(times_s, positions_m, middle_m):
    """When it comes to the middle of its way."""
    after = np.argmax(positions_m > middle_m)
    return np.interp(middle_m, positions_m[after - 1:after + 1], times_s[after - 1:after + 1])


class Trajectories(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.simulation = sync.Simulation(QUICK, options=("--nodes", "2"), deadline_s=60.0).start()
        cls.addClassCleanup(cls.simulation.stop)

    def setUp(self):
        """An earlier test, or an earlier try, leaves nothing behind."""
        for node in NODES:
            with sync.Muscle(self.simulation.address, node) as muscle:
                if muscle.state == State.fault:
                    muscle.reset()
                muscle.disarm()

    def muscle(self, node=1):
        muscle = sync.Muscle(self.simulation.address, node, deadline_s=60.0).connect()
        self.addCleanup(muscle.close)
        muscle.arm()
        return muscle

    def alone(self, use):
        """With asyncio: use(muscle)."""
        async def on_one():
            async with supercoil.Muscle(self.simulation.address, 1, deadline_s=60.0) as muscle:
                await muscle.arm()
                return await use(muscle)
        return asyncio.run(on_one())

    async def under_way(self, muscle, playback):
        """A motion, once the board reports that it has come this far."""
        playing = asyncio.create_task(muscle.play(TIMES_S, way(TIMES_S), settle_s=0.0))
        end = time.monotonic() + DEADLINE_S
        while not playing.done() and ((newest := muscle.telemetry.newest(messages.Trajectory)) is None
                                      or newest.playback < playback):
            self.assertLess(time.monotonic(), end, "never seen")
            await asyncio.sleep(0.005)
        if playing.done():
            await playing
            raise supercoil.PlaybackError("over before this was seen")  # starved
        return playing

    @patient
    def test_the_reference_follows_the_knots_and_then_rests(self):
        muscle = self.muscle()
        with muscle.record("Tracking") as recording:
            muscle.play(TIMES_S, way(TIMES_S), settle_s=0.3)
        self.assertEqual(muscle.state, State.armed)
        times_s, references_m = references(recording)
        middle_s = rising(times_s, references_m, FIRST_M + 0.0005)
        since_start_s = np.clip(times_s - middle_s + LENGTH_S / 4.0, 0.0, LENGTH_S)
        self.assertGreater(np.ptp(references_m), 0.00099)
        np.testing.assert_allclose(references_m, way(since_start_s), atol=NEAR_M)

    @patient
    def test_hold_keeps_the_last_knot(self):
        async def play(muscle):
            await muscle.play([5.0, 5.5, 6.0], [FIRST_M, FIRST_M + 0.0002, FIRST_M + 0.0003], settle_s=0.0, hold=True)
            await muscle.hold(0.5)  # together more than a command lasts
            return muscle.state, muscle.telemetry.tracking.reference_m
        state, reference_m = self.alone(play)
        self.assertEqual(state, State.active)
        self.assertAlmostEqual(reference_m, FIRST_M + 0.0003, 6)

    @patient
    def test_several_muscles_move_in_step(self):
        muscles = [self.muscle(node) for node in NODES]
        scales = (1.0, 0.5)
        recordings = [muscle.record("Tracking").start() for muscle in muscles]
        sync.play([muscle.make_motion(TIMES_S, way(TIMES_S, scale))
                   for muscle, scale in zip(muscles, scales, strict=True)], settle_s=0.3, hold=True)
        for recording in recordings:
            recording.stop()
        ways = []
        for recording, scale in zip(recordings, scales, strict=True):
            times_s, references_m = references(recording)
            ways.append((times_s, (references_m - FIRST_M) / scale))
        times_s = ways[0][0]
        inner = (times_s > ways[1][0][0]) & (times_s < ways[1][0][-1])
        self.assertGreater(np.ptp(ways[0][1]), 0.00099)
        np.testing.assert_allclose(ways[0][1][inner], np.interp(times_s[inner], *ways[1]), atol=NEAR_M)
        self.assertEqual([muscle.state for muscle in muscles], [State.active] * 2)

    @patient
    def test_an_infeasible_knot_is_refused_with_its_time(self):
        muscle = self.muscle()
        with self.assertRaises(supercoil.refusals.Infeasible) as raised:
            muscle.play([7.0, 8.0, 8.2, 8.4], [0.002, 0.0022, 0.02, 0.02], settle_s=0.0)
        self.assertEqual((raised.exception.node, raised.exception.time_s), (1, 8.0))
        self.assertIn("node 1: the knot at 8.000 s is refused: infeasible", str(raised.exception))
        self.assertEqual(muscle.state, State.armed)
        with self.assertRaises(supercoil.refusals.OutOfRange) as raised:
            muscle.play([0.0, 4.0], [0.002, 0.5], settle_s=0.0)
        self.assertEqual(raised.exception.time_s, 4.0)

    @patient
    def test_one_infeasible_motion_ends_all(self):
        one, two = (self.muscle(node) for node in NODES)
        with self.assertRaises(supercoil.refusals.Infeasible) as raised:
            sync.play([one.make_motion(TIMES_S, way(TIMES_S)), two.make_motion([0.0, 0.2], [0.002, 0.02])],
                      settle_s=0.0)
        self.assertEqual(raised.exception.node, 2)
        self.assertEqual((one.state, two.state), (State.armed, State.armed))

    @patient
    def test_a_muscle_must_be_armed(self):
        with sync.Muscle(self.simulation.address, 1) as muscle, self.assertRaises(supercoil.refusals.WrongState):
            muscle.play([0.0, 1.0], [FIRST_M, FIRST_M])

    @patient
    def test_a_late_knot_lets_the_muscle_rest(self):
        muscle = self.muscle()
        send = CanLink.knot
        sent = []

        async def stops_short(link, *knot):
            sent.append(knot)
            if len(sent) > 30:
                raise supercoil.refusals.QueueFull(1, "knot")
            return await send(link, *knot)

        # As if it had no room for what comes later.
        with mock.patch.object(CanLink, "knot", stops_short), \
                mock.patch("supercoil.player.Player.is_loaded", lambda _: len(sent) > 30), \
                self.assertRaisesRegex(supercoil.DryError, r"after the one at 0.580 s came too late"):
            muscle.play(TIMES_S, way(TIMES_S), settle_s=0.0)
        self.assertEqual(muscle.state, State.armed)

    @patient
    def test_reused_sync_numbers_are_skipped(self):
        muscle = self.muscle()
        clock = muscle._muscle._link.clock
        for _ in range(2):  # with the same numbers
            clock._number = 255
            muscle.play([0.0, 1.0], [FIRST_M, FIRST_M + 0.0001], settle_s=0.0)
            self.assertLess(clock._number, 20)  # it went on from there

    @patient
    def test_a_cancelled_motion_lets_the_muscle_rest(self):
        async def cancel(muscle):
            playing = await self.under_way(muscle, Playback.playing)
            playing.cancel()
            try:
                await playing
            except asyncio.CancelledError:
                return muscle.state
        self.assertEqual(self.alone(cancel), State.armed)

    @patient
    def test_another_command_ends_it(self):
        for playback in (Playback.loaded, Playback.playing):
            async def interrupt(muscle, playback=playback):
                playing = await self.under_way(muscle, playback)
                await muscle.set_position(FIRST_M)
                with self.assertRaisesRegex(supercoil.PlaybackError, "received another command in the meantime"):
                    await playing
                return muscle.state
            with self.subTest(playback):
                self.assertEqual(self.alone(interrupt), State.armed)


if __name__ == "__main__":
    unittest.main()
