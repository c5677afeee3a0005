"""Plays one muscle's part in a motion of one or several muscles."""

import math
import time
from typing import NamedTuple

from supercoil.clock import Clock
from supercoil.commands import Commands
from supercoil.errors import DryError, PlaybackError, RefusalError
from supercoil.generated import refusals
from supercoil.generated.names import Playback, When
from supercoil.knots import Knot

_POLL_PERIOD_S = 0.02
_REQUEST_PERIOD_S = 0.05
# Time from Sync to the start, enough for each board to hear of both.
_START_AFTER_S = 0.1
_STARTED_WITHIN_S = 2.0


class Motion(NamedTuple):
    """A trajectory of one muscle, for play()."""

    muscle: Commands
    knots: tuple[Knot, ...]


class Player:
    """Sends a motion's knots as the board has room, and raises whatever ends it early."""

    def __init__(self, motion: Motion) -> None:
        self.muscle = motion.muscle
        self._link = motion.muscle._link
        self._knots = motion.knots
        self._sent = 0
        self._requested_at = -math.inf
        self._started_at = math.inf
        self.clock: Clock = self._link.clock

    async def go_to_start(self, settle_s: float) -> None:
        await self.muscle.set_position(self._knots[0].position_m)
        await self.muscle.hold(settle_s)

    async def load(self) -> None:
        """Sends knots for as long as there is room, after a short wait."""
        await self.muscle._wait(_POLL_PERIOD_S)
        while self._sent < len(self._knots) and (self._sent == 0 or self._link.trajectory.room > 0):
            if not await self._send(self._knots[self._sent]):
                break
            self._sent += 1
            self._requested_at = time.monotonic()
        if time.monotonic() - self._requested_at >= _REQUEST_PERIOD_S:
            self._requested_at = time.monotonic()
            await self._ask(When.never)

    def is_loaded(self) -> bool:
        return self._has_sent_all() or (self._sent > 0 and self._link.trajectory.room == 0)

    async def start(self, sync: int) -> None:
        await self._ask(When.at_sync, sync, _START_AFTER_S)
        self._started_at = time.monotonic()

    def has_ended(self) -> bool:
        return self._has_sent_all() and self._link.trajectory.playback == Playback.ended

    async def go_on(self) -> None:
        await self.load()
        await self._raise_if_stopped()

    async def _raise_if_stopped(self) -> None:
        playback = self._link.trajectory.playback
        node = f"node {self.muscle.node}"
        if playback == Playback.dry or (playback == Playback.ended and not self._has_sent_all()):
            last_s = self._knots[self._sent - 1].time_s
            raise DryError(f"{node}: ran dry: the knot after the one at {last_s:.3f} s came too late")
        if playback == Playback.empty:
            await self._raise_fault()
            raise PlaybackError(f"{node}: no longer playing: it received another command in the meantime, or ran dry")
        if playback == Playback.loaded and time.monotonic() - self._started_at > _STARTED_WITHIN_S:
            raise PlaybackError(f"{node}: has not started: no Sync arrived, or too late")

    def _has_sent_all(self) -> bool:
        return self._sent == len(self._knots)

    async def _send(self, knot: Knot) -> bool:
        """False: the board has no room."""
        self.muscle._kept.raise_if_let_go()
        self.muscle._kept.alive()
        try:
            await self._link.knot(*knot[1:])
        except refusals.QueueFull:
            return False
        except RefusalError as refused:
            if isinstance(refused, refusals.WrongState):
                await self._raise_cause()
            raise type(refused)(refused.node, f"the knot at {knot.time_s:.3f} s", refused.nearest,
                                time_s=knot.time_s) from None
        self.muscle._kept.heats()
        return True

    async def _ask(self, when: When, sync: int = 0, after_s: float = 0.0) -> None:
        try:
            await self._link.play(when, sync, after_s)
        except refusals.WrongState:
            await self._raise_cause()
            raise

    async def _raise_cause(self) -> None:
        """Raises the cause of a refusal because of the state."""
        await self._raise_fault()
        if self._sent > 0:
            await self._raise_if_stopped()

    async def _raise_fault(self) -> None:
        await self.muscle._wait_for_fault()
        await self._link.heartbeat.raise_fault()
