"""Trajectories: knots that a board gets ahead of time, so that it goes from one to the next by itself."""

import asyncio
import math
import time
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from supercoil.clock import Clock
from supercoil.cycles import all_of
from supercoil.errors import DryError, PlaybackError, RefusalError
from supercoil.generated import refusals
from supercoil.generated.names import Playback, When
from supercoil.knots import Knot, knots_of
from supercoil.tuning import Tuning

_LOOK_EVERY_S = 0.02
_ASK_EVERY_S = 0.05
_SYNC_EVERY_S = 1.0
# Between Sync and the start: by then each board has heard of both.
_START_AFTER_S = 0.1
_STARTED_WITHIN_S = 2.0


class Motion(NamedTuple):
    """A trajectory of one muscle, for play()."""

    muscle: "Playing"
    knots: tuple[Knot, ...]


class Playing(Tuning):
    async def play(self, times_s: Iterable[float], positions_m: Iterable[float],
                   velocities_m_per_s: Iterable[float] | None = None, *, settle_s: float = 3.0,
                   hold: bool = False) -> None:
        """A motion that the board goes by itself, from knot to knot, whatever this program does meanwhile. Goes to the
        first knot, waits there for settle_s seconds, plays, and returns at the end.

        times_s, positions_m, velocities_m_per_s: one column each, with a number for each knot: a list, or an array of
        one dimension. 2 knots or more, each 0.001 to 4.094 s after the one before (sent as whole milliseconds); 50 a
        second are plenty, and the first one's time may be any. Positions from -0.8388607 to 0.8388607 m, and what the
        board allows; velocities from -0.32767 to 0.32767 m/s, 0 at the first and the last knot. Without velocities
        those of the parabola through three knots are taken, and 0 at both ends.

        hold: the muscle is kept at the last knot, as after move_to(); else it rests.

        ValueError: what is given is wrong; says in which row. Nothing was sent then. refusals.Infeasible: the way to a
        knot asks for more power than there is, or for cooling; time_s says to which one. refusals.OutOfRange, likewise.
        DryError: a knot came too late. refusals.NoLease, refusals.NotLeaseHolder: the lease was lost. PlaybackError:
        something else was commanded meanwhile. faults: one has latched. After each of them, and where the task is
        cancelled, the muscle rests."""
        await play([self.make_motion(times_s, positions_m, velocities_m_per_s)], settle_s=settle_s, hold=hold)

    def make_motion(self, times_s: Iterable[float], positions_m: Iterable[float],
                    velocities_m_per_s: Iterable[float] | None = None) -> Motion:
        """Of several muscles, for supercoil.play(). Columns and ValueError are those of play(); nothing is sent."""
        return Motion(self, knots_of(times_s, positions_m, velocities_m_per_s))


class _Player:
    """One muscle's part."""

    def __init__(self, motion: Motion) -> None:
        self.muscle = motion.muscle
        self._link = motion.muscle._link
        self._knots = motion.knots
        self._sent = 0
        self._asked_at = -math.inf
        self._started_at = math.inf
        self.clock: Clock = self._link.clock

    async def go_to_start(self, settle_s: float) -> None:
        await self.muscle.set_position(self._knots[0].position_m)
        await self.muscle.hold(settle_s)

    async def load(self) -> None:
        """Knots as long as there is room, after a short while."""
        await self.muscle._wait(_LOOK_EVERY_S)
        while self._sent < len(self._knots) and (self._sent == 0 or self._link.trajectory.room > 0):
            if not await self._send(self._knots[self._sent]):
                break
            self._sent += 1
            self._asked_at = time.monotonic()
        if time.monotonic() - self._asked_at >= _ASK_EVERY_S:
            self._asked_at = time.monotonic()
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
            raise PlaybackError(f"{node}: plays no longer: it was told something else meanwhile, or has run dry")
        if playback == Playback.loaded and time.monotonic() - self._started_at > _STARTED_WITHIN_S:
            raise PlaybackError(f"{node}: has not started: no Sync came, or too late")

    def _has_sent_all(self) -> bool:
        return self._sent == len(self._knots)

    async def _send(self, knot: Knot) -> bool:
        """False: there is no room."""
        self.muscle._kept.raise_if_let_go()
        self.muscle._kept.alive()
        try:
            await self._link.knot(*knot[1:])
        except refusals.QueueFull:
            return False
        except RefusalError as refused:
            if isinstance(refused, refusals.WrongState):
                await self._raise_cause()
            raise type(refused)(refused.node, f"the knot at {knot.time_s:.3f} s", time_s=knot.time_s) from None
        self.muscle._kept.heats()
        return True

    async def _ask(self, when: When, sync: int = 0, after_s: float = 0.0) -> None:
        try:
            await self._link.play(when, sync, after_s)
        except refusals.WrongState:
            await self._raise_cause()
            raise

    async def _raise_cause(self) -> None:
        """Of a refusal because of the state."""
        await self._raise_fault()
        if self._sent > 0:
            await self._raise_if_stopped()

    async def _raise_fault(self) -> None:
        await self.muscle._hear_of_fault()
        await self._link.heartbeat.raise_fault()


async def play(motions: Sequence[Motion], *, settle_s: float = 3.0, hold: bool = False) -> None:
    """Motions of several muscles, in step: all on one bus start in the same tick, and a Sync a second keeps their
    clocks together. Those on other buses start as soon after as this program can send.

    motions: what make_motion() of each muscle gives, each muscle once. They need not be equally long: whichever ends
    first waits at its last knot. All else is as with play() of one muscle, and one that cannot go on ends all."""
    muscles = [motion.muscle for motion in motions]
    if len(set(map(id, muscles))) < len(muscles):
        raise ValueError("a muscle has two motions")
    if not 0.0 <= settle_s < math.inf:
        raise ValueError(f"settle_s {settle_s}: must be 0 or more")
    players = [_Player(motion) for motion in motions]
    try:
        await _play(players, settle_s)
    except BaseException:
        await asyncio.gather(*(muscle.rest() for muscle in muscles), return_exceptions=True)
        raise
    if not hold:
        await all_of(muscle.rest() for muscle in muscles)


async def _play(players: Sequence[_Player], settle_s: float) -> None:
    await all_of(player.go_to_start(settle_s) for player in players)
    while not all(player.is_loaded() for player in players):
        await all_of(player.load() for player in players)
    clocks = {player.clock for player in players}
    try:
        await _start(players, clocks)
    except refusals.OutOfRange:
        for clock in clocks:
            clock.avoid_known()
        await _start(players, clocks)
    synced_at = time.monotonic()
    while not all(player.has_ended() for player in players):
        await all_of(player.go_on() for player in players)
        if time.monotonic() - synced_at >= _SYNC_EVERY_S:
            synced_at = time.monotonic()
            for clock in clocks:
                await clock.sync(clock.next_number())


async def _start(players: Sequence[_Player], clocks: Iterable[Clock]) -> None:
    numbers = {clock: clock.next_number() for clock in clocks}
    await all_of(player.start(numbers[player.clock]) for player in players)
    for clock, number in numbers.items():
        await clock.sync(number)
