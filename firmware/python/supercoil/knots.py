"""A trajectory as knots, checked as far as possible without a board."""

import itertools
import math
from collections.abc import Iterable
from typing import Any, NamedTuple

from supercoil import codec
from supercoil.generated import messages

_STEPS_PER_S = 1000  # the bus has whole milliseconds
_MIN_ROWS = 2


class Knot(NamedTuple):
    time_s: float  # as it was given
    after_s: float  # since the previous knot; 0 for the first
    position_m: float
    velocity_m_per_s: float


def _max_value(signal: str) -> float:
    """The largest value that a knot can carry."""
    sent = codec.encode(codec.LAYOUTS[messages.KNOT], {signal: math.inf})
    return float(getattr(codec.decode(messages.KNOT, sent), signal))


MAX_AFTER_S = _max_value("after_s")
MAX_POSITION_M = _max_value("position_m")
MAX_VELOCITY_M_PER_S = _max_value("velocity_m_per_s")
# A velocity up to this is sent as 0.
_STANDSTILL_M_PER_S = 0.49e-5


def _column(name: str, values: Iterable[float], max_abs: float = math.inf) -> list[float]:
    shape: Any = getattr(values, "shape", None)
    if shape is not None and len(shape) != 1:
        raise ValueError(f"{name}: must be one column with a number for each knot; its shape is {shape}")
    column = []
    for row, value in enumerate(values):
        try:
            number = float(value)
        except (TypeError, ValueError):
            number = math.nan
        if not math.isfinite(number):
            raise ValueError(f"row {row}: {name} is {value!r}; it must be a finite number")
        if abs(number) > max_abs:
            raise ValueError(f"row {row}: {name} is {number:.7g}; it must be {-max_abs:.7g} to {max_abs:.7g}")
        column.append(number)
    return column


def _steps(times_s: list[float]) -> list[float]:
    """Times since the previous row; the first is 0."""
    counts = [round((time_s - times_s[0]) * _STEPS_PER_S) for time_s in times_s]
    max_count = round(MAX_AFTER_S * _STEPS_PER_S)
    for row in range(1, len(counts)):
        if not 1 <= counts[row] - counts[row - 1] <= max_count:
            raise ValueError(f"row {row}: times_s is {times_s[row] - times_s[row - 1]:.7g} s after the row before; it "
                             f"must be {1 / _STEPS_PER_S:g} to {MAX_AFTER_S:g} s")
    return [0.0] + [(after - before) / _STEPS_PER_S for before, after in itertools.pairwise(counts)]


def _slopes(steps_s: list[float], positions_m: list[float]) -> list[float]:
    """Slopes of the parabola through three rows; 0 at both ends."""
    slopes = [0.0] * len(positions_m)
    for row in range(1, len(positions_m) - 1):
        before_s, after_s = steps_s[row], steps_s[row + 1]
        before = (positions_m[row] - positions_m[row - 1]) / before_s
        after = (positions_m[row + 1] - positions_m[row]) / after_s
        slopes[row] = (before * after_s + after * before_s) / (before_s + after_s)
    return slopes


def knots_of(times_s: Iterable[float], positions_m: Iterable[float],
             velocities_m_per_s: Iterable[float] | None = None) -> tuple[Knot, ...]:
    """ValueError: names the row, from 0, that is wrong, and what it must be."""
    times, positions = _column("times_s", times_s), _column("positions_m", positions_m, MAX_POSITION_M)
    columns = {"positions_m": positions}
    if velocities_m_per_s is not None:
        columns["velocities_m_per_s"] = _column("velocities_m_per_s", velocities_m_per_s, MAX_VELOCITY_M_PER_S)
    for name, column in columns.items():
        if len(column) != len(times):
            raise ValueError(f"{name} has {len(column)} rows and times_s has {len(times)}")
    if len(times) < _MIN_ROWS:
        raise ValueError(f"a trajectory needs at least {_MIN_ROWS} rows, not {len(times)}")
    steps = _steps(times)
    velocities = columns.get("velocities_m_per_s") or _slopes(steps, positions)
    _column("the velocity between its neighbours, in m/s,", velocities, MAX_VELOCITY_M_PER_S)
    for row in (0, len(times) - 1):
        if abs(velocities[row]) > _STANDSTILL_M_PER_S:
            raise ValueError(f"row {row}: velocities_m_per_s is {velocities[row]:.7g}; the first and the last one must "
                             "be 0")
    return tuple(map(Knot, times, steps, positions, velocities))
