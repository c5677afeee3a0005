"""Trajectories: knots that a board receives ahead of time, so that it moves from one to the next by itself."""

import asyncio
import time
from collections.abc import Iterable, Sequence

from supercoil.cycles import all_of
from supercoil.knots import knots_of
from supercoil.named import number
from supercoil.player import Motion, Player
from supercoil.tuning import Tuning

_SYNC_PERIOD_S = 1.0


class Playing(Tuning):
    async def play(self, times_s: Iterable[float], positions_m: Iterable[float],
                   velocities_m_per_s: Iterable[float] | None = None, *, settle_s: float = 3.0,
                   hold: bool = False) -> None:
        """A motion that the board follows by itself from knot to knot, on time even if this program and its bus are a
        little late. Goes to the first knot, waits there for settle_s seconds, plays, and returns at the end.

        times_s, positions_m, velocities_m_per_s: one column each, with a number for each knot: a list, or a
        one-dimensional array. 2 knots or more, each 0.001 to 4.094 s after the previous one (sent as whole
        milliseconds); 50 a second are plenty, and the first time is arbitrary. Positions from -0.8388607 to
        0.8388607 m, and what the board allows; velocities from -0.32767 to 0.32767 m/s, 0 at the first and the last
        knot. Without velocities, those of the parabola through three knots are taken, and 0 at both ends.

        hold: the muscle is kept at the last knot, as after move_to(); otherwise it rests.

        ValueError: the input is wrong; it names the row, from 0, and nothing is sent. refusals.Infeasible: the way to
        the knot at its time_s needs more power than there is, or faster cooling; likewise refusals.OutOfRange.
        DryError: a knot came too late. refusals.NoLease, refusals.NotLeaseHolder: the lease was lost. PlaybackError:
        another command came meanwhile. faults.*: one has latched. After each of these, and if the task is cancelled,
        the muscle rests."""
        await play([self.make_motion(times_s, positions_m, velocities_m_per_s)], settle_s=settle_s, hold=hold)

    def make_motion(self, times_s: Iterable[float], positions_m: Iterable[float],
                    velocities_m_per_s: Iterable[float] | None = None) -> Motion:
        """A motion for supercoil.play() of several muscles. Columns and ValueError as for play(); nothing is sent."""
        return Motion(self, knots_of(times_s, positions_m, velocities_m_per_s))


async def play(motions: Sequence[Motion], *, settle_s: float = 3.0, hold: bool = False) -> None:
    """Plays motions of several muscles in step: all on one bus start in the same tick, and a Sync a second keeps their
    clocks together; so do all of one board that is commanded over its socket, as they share its clock. Those on other
    buses start as soon after as this program can send.

    motions: the results of make_motion(), each muscle once. They need not be equally long: a muscle that ends first
    waits at its last knot. Everything else is as with play() of one muscle, and one that cannot go on ends all."""
    muscles = [motion.muscle for motion in motions]
    if len(set(map(id, muscles))) < len(muscles):
        raise ValueError("a muscle has two motions")
    number("settle_s", settle_s, 0.0)
    players = [Player(motion) for motion in motions]
    try:
        await _play(players, settle_s)
        if not hold:
            await all_of(muscle.rest() for muscle in muscles)
    except BaseException:
        await asyncio.gather(*(muscle.rest() for muscle in muscles), return_exceptions=True)
        raise


async def _play(players: Sequence[Player], settle_s: float) -> None:
    await all_of(player.go_to_start(settle_s) for player in players)
    while not all(player.is_loaded() for player in players):
        await all_of(player.load() for player in players)
    clocks = {player.clock for player in players}
    numbers = {clock: clock.next_number() for clock in clocks}
    await all_of(player.start(numbers[player.clock]) for player in players)
    for clock, sync_number in numbers.items():
        await clock.sync(sync_number)
    synced_at = time.monotonic()
    while not all(player.has_ended() for player in players):
        await all_of(player.go_on() for player in players)
        if time.monotonic() - synced_at >= _SYNC_PERIOD_S:
            synced_at = time.monotonic()
            for clock in clocks:
                await clock.sync(clock.next_number())
