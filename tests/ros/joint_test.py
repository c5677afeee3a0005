"""What a joint does when things go wrong at the wrong moment: with a muscle that is told when to fail."""

import asyncio
import contextlib
import math
import types
import unittest
from typing import ClassVar
from unittest import mock

from supercoil import BusError, Fault, FaultError, NoAnswerError, NotReachedError, State, messages, refusals
from supercoil import joints as pairs
from supercoil.ros import joint as joints
from supercoil.ros.diagnostics import diagnostics_of
from supercoil.ros.messages import STALE, WARN

WITHIN_S = 30.0


class Muscle:
    """A stand-in for supercoil.Muscle."""

    PAIRS: ClassVar = {}  # by node

    def __init__(self, address, node):
        self.node = node
        self.state, self.fault, self.calls = State.armed, Fault.none, []
        self.arming, self.silent, self.let_go = asyncio.Event(), asyncio.Event(), asyncio.Event()
        self.let_go.set()
        self._telemetry = types.SimpleNamespace(newest=lambda kind: None)
        self.at_close = self.refuses = None
        MADE.append(self)

    @property
    def telemetry(self):
        if "close" in self.calls:
            raise RuntimeError(f"node {self.node} is not connected")
        return self._telemetry

    async def __aenter__(self):
        return self

    async def __aexit__(self, *cause):
        self.calls.append("close")
        await self.let_go.wait()
        if self.at_close:
            raise self.at_close

    async def joint(self):
        return self.PAIRS.get(self.node)

    async def stream(self, kind):
        await self.silent.wait()
        raise NoAnswerError("no Status within 2 s\nand more")
        yield

    async def arm(self):
        self.arming.set()
        await asyncio.Event().wait()

    async def disarm(self):
        self.calls.append("disarm")

    async def set_position(self, position_m):
        self.calls.append(position_m)
        if self.refuses:
            await self.refuses(position_m)

    async def rest(self):
        self.calls.append("rest")


MADE = []


class FaultWithoutText(FaultError):
    def __str__(self):
        return ""


class Connected(unittest.IsolatedAsyncioTestCase):
    async def asyncSetUp(self):
        patched = mock.patch.object(joints, "Muscle", Muscle)
        patched.start()
        self.addCleanup(patched.stop)
        MADE.clear()
        self.joint = joints.Joint("finger", "can0", 1)
        self.running = asyncio.create_task(self.joint.run())
        await self.until(lambda: self.joint.muscle is not None)
        self.muscle = MADE[0]

    async def asyncTearDown(self):
        self.muscle.at_close = None
        self.muscle.let_go.set()
        self.running.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await self.running

    async def until(self, wanted):
        async with asyncio.timeout(WITHIN_S):
            while not wanted():  # noqa: ASYNC110 - nothing tells of it
                await asyncio.sleep(0.001)

    def want(self, position_m):
        self.joint.motion = None if position_m is None else types.SimpleNamespace(at=lambda now_s: position_m)
        self.joint.follow(0.0)


class JointAlone(Connected):
    async def test_an_error_on_closing_does_not_block_cancellation(self):
        self.muscle.at_close = BusError("the bus is gone")
        self.running.cancel()
        done, _ = await asyncio.wait([self.running], timeout=WITHIN_S)
        self.assertEqual(done, {self.running})
        self.assertTrue(self.running.cancelled())

    async def test_a_silent_board_is_stale_while_it_is_released(self):
        self.muscle.let_go.clear()
        self.muscle.silent.set()
        await self.until(lambda: "close" in self.muscle.calls)
        self.assertTrue(math.isnan(self.joint.position))
        diagnosis = diagnostics_of([self.joint], stopped=False).status[1]
        self.assertEqual((diagnosis.level, diagnosis.message), (STALE, "its connection has ended"))
        with self.assertRaisesRegex(NotReachedError, "its connection has ended"):
            await self.joint.reset()
        self.muscle.let_go.set()
        await self.until(lambda: self.joint.problem.startswith("no Status"))
        diagnosis = diagnostics_of([self.joint], stopped=False).status[1]
        self.assertEqual((diagnosis.level, diagnosis.message), (STALE, "no Status within 2 s"))

    async def test_a_silent_board_is_reconnected(self):
        patched = mock.patch.object(joints, "_TRY_AGAIN_S", 0.0)
        patched.start()
        self.addCleanup(patched.stop)
        for times in range(1, 3):
            MADE[-1].silent.set()
            await self.until(lambda times=times: len(MADE) > times and self.joint.muscle is MADE[-1])
        self.want(0.001)
        await self.until(lambda: 0.001 in MADE[-1].calls)

    async def test_an_error_without_text_is_diagnosed_by_its_type(self):
        self.muscle.at_close = BusError()
        self.muscle.silent.set()
        await self.until(lambda: self.muscle.calls == ["close"] and self.joint.muscle is None)
        await self.until(lambda: self.joint.problem != "its connection has ended")
        diagnosis = diagnostics_of([self.joint], stopped=False).status[1]
        self.assertEqual((diagnosis.level, diagnosis.message), (STALE, "BusError"))

    async def test_a_refusal_without_text_is_diagnosed_by_its_type(self):
        async def refuse(position_m):
            raise FaultWithoutText(1, math.nan, math.nan)
        self.muscle.refuses = refuse
        self.want(0.001)
        await self.until(lambda: self.joint.refusal)
        diagnosis = diagnostics_of([self.joint], stopped=False).status[1]
        self.assertEqual((diagnosis.level, diagnosis.message), (WARN, "FaultWithoutText"))

    async def test_a_released_set_point_rests_before_the_next_heartbeat(self):
        self.want(0.001)
        await self.until(lambda: 0.001 in self.muscle.calls)
        self.want(None)  # told as armed until now
        await self.until(lambda: "rest" in self.muscle.calls)

    async def test_disarm_ends_a_waiting_arm(self):
        self.muscle.state = State.disarmed
        arming = asyncio.create_task(self.joint.arm())
        await self.muscle.arming.wait()
        self.assertEqual(await self.joint.disarm(), "disarmed")
        with self.assertRaises(NotReachedError):
            await asyncio.wait_for(arming, WITHIN_S)

    async def test_a_refusal_refers_to_the_refused_position(self):
        async def refuse(position_m):
            if position_m > 0.004:
                self.want(0.001)  # meanwhile
                raise refusals.OutOfRange(1, "position", 0.004)
        self.muscle.refuses = refuse
        self.want(3.0)
        await self.until(lambda: 3.0 in self.muscle.calls)
        await self.until(lambda: self.joint.refusal)
        self.want(0.002)
        await self.until(lambda: 0.002 in self.muscle.calls)
        self.want(3.0)
        await self.until(lambda: "0.004000 m is in" in self.joint.refusal)
        self.assertEqual(self.muscle.calls.count(3.0), 1)


class JointOfTwo(Connected):
    """A joint that another muscle turns back, at a lever that depends on the angle."""

    TABLE = pairs.LeverTable(-30.0, 30.0, (0.012, 0.015, 0.011))

    async def asyncSetUp(self):
        Muscle.PAIRS.update({1: pairs.Joint(0.015, 2, self.TABLE), 2: pairs.Joint(-0.015, 1, self.TABLE)})
        self.addCleanup(Muscle.PAIRS.clear)
        await super().asyncSetUp()

    async def test_radians_and_metres_convert_by_the_lever_table(self):
        self.want(0.2)
        await self.until(lambda: self.muscle.calls)
        self.assertAlmostEqual(self.muscle.calls[0], self.TABLE.arc_m(0.2), 12)
        measured = messages.Measurement(1.0, self.TABLE.arc_m(-0.3), math.nan, math.nan)
        self.muscle.telemetry.newest = lambda kind: measured
        self.assertAlmostEqual(self.joint.position, -0.3, 12)
        self.assertEqual(self.joint.unit, "rad")

    async def test_the_antagonist_is_observed_and_not_commanded(self):
        await self.until(lambda: self.joint.antagonist is not None)
        self.want(0.2)
        await self.until(lambda: self.muscle.calls)
        self.assertEqual((self.joint.antagonist.node, self.joint.antagonist.calls), (2, []))

    async def test_the_antagonist_is_not_a_joint(self):
        led = joints.Joint("back", "can0", 2)
        running = asyncio.create_task(led.run())
        self.addCleanup(running.cancel)
        await self.until(lambda: led.muscle is not None)
        self.assertEqual((led.is_led, led.turns), (True, False))
        led.motion = types.SimpleNamespace(at=lambda now_s: 0.001)
        led.follow(0.0)
        await self.until(lambda: led.refusal)
        self.assertEqual((led.refusal, led.muscle.calls), ("is the antagonist of a joint: command node 1 instead", []))

    async def test_the_lever_is_read_again_before_arming(self):
        Muscle.PAIRS[1] = pairs.Joint(0.020, 2)
        self.muscle.state = State.disarmed
        arming = asyncio.create_task(self.joint.arm())
        await self.muscle.arming.wait()
        self.assertEqual(self.joint.pair.lever_m, 0.020)
        await self.joint.disarm()
        with self.assertRaises(NotReachedError):
            await arming


if __name__ == "__main__":
    unittest.main()
