"""A muscle, or two that turn it both ways, as a joint of ROS: connected while its board is reached, and commanded."""

import asyncio
import contextlib
import logging
import math
import time

from supercoil.errors import FaultError, NotReachedError, RefusalError, SupercoilError
from supercoil.generated import messages, refusals
from supercoil.generated.names import Fault, State
from supercoil.joints import Joint as Pair
from supercoil.muscle import Muscle
from supercoil.ros.motion import Motion

_TRY_AGAIN_S = 1.0
_STALE_S = 0.5
_REPORT_REFUSALS_S = 5.0
# A set point that holds is sent again this often, so that a board that others put to rest moves again.
_RESEND_PERIOD_S = 0.5

_UNKNOWN_RANGE_M = (-math.inf, math.inf)
_ENDED = "its connection has ended"  # until the cause is known

_log = logging.getLogger("supercoil.ros")


def reason_of(error: BaseException) -> str:
    """The first line of the error's text, or its kind if it has none: never empty."""
    return str(error).partition("\n")[0] or type(error).__name__


class _Refused(Exception):
    """Refused here, before the board was asked."""


class Joint:
    """Its positions are in metres, or in radians if its muscle and another one turn a joint: `unit` tells which."""

    def __init__(self, name: str, address: str, node: int) -> None:
        self.name = name
        self.node = node
        self.hardware_id = f"{address} node {node}"
        self.pair: Pair | None = None  # as the board last reported it
        self.problem = "not connected yet"  # why the board is not reached, if it is not
        self.motion: Motion | None = None
        self.address = address
        self._muscle: Muscle | None = None
        self._antagonist: Muscle | None = None
        self._wanted: float | None = None
        self._wake = asyncio.Event()
        self._arming: asyncio.Task[None] | None = None
        self._range_m = _UNKNOWN_RANGE_M
        self._refusal = ""
        self._refused_at_s = -math.inf
        self._measurement_time_s = math.nan
        self._measured_at_s = -math.inf

    @property
    def muscle(self) -> Muscle | None:
        """None: its board is not reached."""
        return self._muscle

    @property
    def antagonist(self) -> Muscle | None:
        """The muscle that turns it back, which is only listened to; None: it is not reached, or there is none."""
        return self._antagonist

    @property
    def turns(self) -> bool:
        return self.pair is not None and self.pair.lever_m > 0.0

    @property
    def is_led(self) -> bool:
        """Whether it turns another one's joint back, and is no joint of ROS."""
        return self.pair is not None and self.pair.lever_m < 0.0

    @property
    def antagonist_node(self) -> int | None:
        """The node of the muscle that turns it back; None: there is none."""
        return self.pair.other_node if self.pair is not None and self.turns else None

    @property
    def unit(self) -> str:
        return "rad" if self.turns else "m"

    def of_m(self, position_m: float) -> float:
        return math.radians(self.pair.angle_deg(position_m)) if self.pair and self.turns else position_m

    def _to_m(self, position: float) -> float:
        return self.pair.position_m(math.degrees(position)) if self.pair and self.turns else position

    @property
    def refusal(self) -> str:
        """The refusal of the last seconds; empty: none."""
        return self._refusal if time.monotonic() - self._refused_at_s < _REPORT_REFUSALS_S else ""

    @property
    def position(self) -> float:
        """The position; NaN: no fresh reading."""
        now_s = time.monotonic()
        measured = self._muscle.telemetry.newest(messages.Measurement) if self._muscle else None
        if measured is None:
            return math.nan
        if measured.time_s != self._measurement_time_s:
            self._measurement_time_s, self._measured_at_s = measured.time_s, now_s
        return self.of_m(measured.position_m) if now_s - self._measured_at_s <= _STALE_S else math.nan

    @property
    def set_point(self) -> float | None:
        return self._wanted

    def refuse(self, why: str) -> None:
        """Reports a refusal to diagnostics, and once in the log."""
        if why != self.refusal:
            _log.warning("%s: %s", self.name, why)
        self._refusal, self._refused_at_s = why, time.monotonic()

    def follow(self, now_s: float) -> None:
        """now_s: by the monotonic clock."""
        wanted = self.motion.at(now_s) if self.motion else None
        if wanted is None:
            self.motion = None
        if wanted != self._wanted:
            self._wanted = wanted
            self._wake.set()

    def let_go(self) -> None:
        self.motion = None
        self._wanted = None
        self._wake.set()

    async def run(self) -> None:
        """Connects, again and again, and obeys while connected."""
        while True:
            try:
                async with Muscle(self.address, self.node) as muscle:
                    self.pair = await muscle.joint()
                    self._muscle, self.problem = muscle, _ENDED
                    _log.info("%s: %s is there", self.name, self.hardware_id)
                    try:
                        # A task of its own: Python 3.11 leaves the one in which a TaskGroup fails cancelled.
                        await asyncio.create_task(self._use(muscle))
                    finally:
                        # The board is silent, and letting go of a silent one takes a while.
                        self._muscle = None
                        self._stop_arming()
            except* SupercoilError as errors:
                error = errors.exceptions[0]
                if reason_of(error) != self.problem:
                    _log.error("%s: %s", self.name, error)
                self.problem = reason_of(error)
            if (task := asyncio.current_task()) is not None and task.cancelling():
                raise asyncio.CancelledError  # an error on the way out must not keep it here
            self.let_go()
            await asyncio.sleep(_TRY_AGAIN_S)

    async def _use(self, muscle: Muscle) -> None:
        async with asyncio.TaskGroup() as tasks:
            tasks.create_task(self._watch(muscle))
            tasks.create_task(self._obey(muscle))
            tasks.create_task(self._listen())

    async def _watch(self, muscle: Muscle) -> None:
        """Ends when the board is silent. What was wanted before a stop or a fault is dropped."""
        async for status in muscle.stream(messages.Status):
            if status.state not in (State.armed, State.active):
                self.let_go()

    async def _listen(self) -> None:
        """Listens to the muscle that turns it back. Its silence does not stop this one: its board judges that."""
        while True:
            if (node := self.antagonist_node) is not None:
                with contextlib.suppress(SupercoilError):
                    async with Muscle(self.address, node) as antagonist:
                        self._antagonist = antagonist
                        try:
                            async for _ in antagonist.stream(messages.Status):
                                pass
                        finally:
                            self._antagonist = None
            await asyncio.sleep(_TRY_AGAIN_S)

    async def _obey(self, muscle: Muscle) -> None:
        ours = False  # whether the muscle moves because of us
        while True:
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(_RESEND_PERIOD_S):
                    await self._wake.wait()
            self._wake.clear()
            wanted_m = None if self._wanted is None else self._to_m(self._wanted)
            try:
                if wanted_m is not None:
                    self._check(muscle, wanted_m)
                    ours = True
                    await muscle.set_position(wanted_m)
                elif ours:
                    # Heartbeats are slower than commands: the muscle may be active and still be reported as armed.
                    if muscle.state in (State.armed, State.active):
                        await muscle.rest()
                    ours = False
            except (RefusalError, FaultError, _Refused) as error:
                self.refuse(self._reason(error, wanted_m))
                self.let_go()  # the muscle then rests, if it moved

    def _check(self, muscle: Muscle, position_m: float) -> None:
        """Checks before the board is asked: there, ten refusals in a row are a fault."""
        if self.pair is not None and self.is_led:
            raise _Refused(f"is the antagonist of a joint: command node {self.pair.other_node} instead")
        if muscle.state not in (State.armed, State.active):
            raise _Refused(f"is {muscle.state}: it cannot move")
        low_m, high_m = self._range_m
        if not low_m <= position_m <= high_m:
            nearest_m = low_m if position_m < low_m else high_m
            raise _Refused(self._out_of_range(position_m, nearest_m))

    def _out_of_range(self, position_m: float, nearest_m: float) -> str:
        position, nearest = self.of_m(position_m), self.of_m(nearest_m)
        return f"{position:.6f} {self.unit} is out of range; {nearest:.6f} {self.unit} is in range"

    def _reason(self, error: Exception, position_m: float | None) -> str:
        """The error in the joint's unit. Remembers the ends of its range when the board reports them."""
        if isinstance(error, refusals.OutOfRange) and math.isfinite(error.nearest) and position_m is not None:
            low_m, high_m = self._range_m
            self._range_m = (low_m, error.nearest) if position_m > error.nearest else (error.nearest, high_m)
            return self._out_of_range(position_m, error.nearest)
        return reason_of(error)

    async def arm(self) -> str:
        """Returns the outcome, as do the others. Raises SupercoilError if it failed."""
        muscle = self._connected()
        self.let_go()
        if muscle.state in (State.armed, State.active):
            return "is armed"
        arming = self._arming = asyncio.create_task(self._arm(muscle))
        try:
            await arming
        except asyncio.CancelledError:
            if (task := asyncio.current_task()) is not None and task.cancelling():
                raise
            raise NotReachedError("was stopped while it was being armed") from None
        return "armed"

    async def _arm(self, muscle: Muscle) -> None:
        """What is known of the board may have changed since."""
        self._range_m = _UNKNOWN_RANGE_M
        self.pair = await muscle.joint()
        await muscle.arm()

    def _stop_arming(self) -> None:
        if self._arming is not None:
            self._arming.cancel()

    async def disarm(self) -> str:
        self.let_go()
        self._stop_arming()
        await self._connected().disarm()
        return "disarmed"

    async def reset(self) -> str:
        self.let_go()
        muscle = self._connected()
        if muscle.fault == Fault.none:
            return "has no fault"
        await muscle.reset()
        return "reset"

    def _connected(self) -> Muscle:
        if self._muscle is None:
            raise NotReachedError(self.problem)
        return self._muscle
