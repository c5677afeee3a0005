"""Where a joint is to be, from what ROS has sent: a set point for some time, or a trajectory.

Positions and velocities are in the joint's unit: m and m/s, or rad and rad/s for one that turns."""

import bisect
import math
from collections.abc import Callable
from typing import NamedTuple, Protocol

from supercoil.ros import messages

_MAX_DURATION_S = 600.0
# A wrong clock must not hold a muscle where it is for a year.
_MAX_WAIT_S = 60.0


class Motion(Protocol):
    def at(self, now_s: float) -> float | None:
        """The set point at this time; None: it has ended. Times are those of the monotonic clock: a wall clock that is
        set back must not keep a muscle hot."""


class Held(NamedTuple):
    position: float
    until_s: float

    def at(self, now_s: float) -> float | None:
        return self.position if now_s < self.until_s else None


class Knot(NamedTuple):
    time_s: float
    position: float
    velocity: float | None


def _between(before: Knot, after: Knot, time_s: float) -> float:
    """A cubic if both velocities are known, otherwise a straight line."""
    length = after.time_s - before.time_s
    t = (time_s - before.time_s) / length
    if before.velocity is None or after.velocity is None:
        return before.position + t * (after.position - before.position)
    # Hermite cubic.
    return ((1 + 2 * t) * (1 - t) ** 2 * before.position + t * (1 - t) ** 2 * length * before.velocity
            + t * t * (3 - 2 * t) * after.position - t * t * (1 - t) * length * after.velocity)


class Trajectory:
    """of: tells whether its sender still exists. Its last point is held for as long as that."""

    def __init__(self, knots: list[Knot], of: Callable[[], bool]) -> None:
        self._knots = knots
        self._times = [knot.time_s for knot in knots]
        self._sender_is_there = of

    def at(self, now_s: float) -> float | None:
        after = bisect.bisect_right(self._times, now_s)
        if after == 0:
            return self._knots[0].position
        if after == len(self._knots):
            return self._knots[-1].position if self._sender_is_there() else None
        return _between(self._knots[after - 1], self._knots[after], now_s)


def _column(values: list[float], joint: int, joints: int, what: str, point: int) -> float | None:
    if not values and what != "positions":
        return None
    if len(values) != joints:
        raise ValueError(f"points[{point}].{what} has {len(values)} values for {joints} joints")
    if not math.isfinite(values[joint]):
        raise ValueError(f"points[{point}].{what}[{joint}] is {values[joint]}")
    return values[joint]


def knots_of(message: messages.JointTrajectory, joint: int, start: Knot, wall_clock_s: float) -> list[Knot]:
    """Knots for one of its joints. start: now, and where the joint is. A header without a time begins now; one with a
    time begins when the wall clock, as it is set now, reaches it.

    ValueError says what is wrong with the message."""
    stamp_s = messages.in_seconds(message.header.stamp)
    begins_s = start.time_s + (stamp_s - wall_clock_s if stamp_s else 0.0)
    if begins_s > start.time_s + _MAX_WAIT_S:
        raise ValueError(f"begins in {begins_s - start.time_s:.6g} s; must be at most {_MAX_WAIT_S:g}. Are both clocks "
                         "right?")
    joints = len(message.joint_names)
    knots: list[Knot] = []
    for number, point in enumerate(message.points):
        after_s = messages.in_seconds(point.time_from_start)
        if not 0.0 <= after_s <= _MAX_DURATION_S:
            raise ValueError(f"points[{number}].time_from_start is {after_s:g} s; must be 0 to {_MAX_DURATION_S:g}")
        position = _column(point.positions, joint, joints, "positions", number)
        velocity = _column(point.velocities, joint, joints, "velocities", number)
        assert position is not None
        if knots and begins_s + after_s <= knots[-1].time_s:
            raise ValueError(f"points[{number}].time_from_start is not after the one before")
        knots.append(Knot(begins_s + after_s, position, velocity))
    if not knots:
        raise ValueError("has no points")
    if knots[-1].time_s < start.time_s:
        raise ValueError(f"ended {start.time_s - knots[-1].time_s:.3g} s ago")
    if knots[0].time_s > start.time_s:
        # The joint stays where it is until the trajectory begins, and goes to the first point from there.
        at_rest = start._replace(time_s=max(begins_s, start.time_s))
        if at_rest.time_s < knots[0].time_s:
            knots.insert(0, at_rest)
        if start.time_s < at_rest.time_s:
            knots.insert(0, start._replace(velocity=None))
    return knots
