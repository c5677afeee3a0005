"""The joint that a muscle turns, against another muscle that turns it back."""

import itertools
import math
from collections.abc import Mapping
from typing import NamedTuple

from supercoil.generated.names import Quantity

_POINTS = tuple(quantity for quantity in Quantity
                if Quantity.joint_lever_1_m <= quantity <= Quantity.joint_lever_7_m)
QUANTITIES = (Quantity.joint_lever_m, Quantity.joint_other_node_offset,
              Quantity.joint_lever_first_rad, Quantity.joint_lever_last_rad, *_POINTS)


class LeverTable(NamedTuple):
    """The lever over the joint's angle: given at evenly spaced angles, linear in between, constant beyond."""

    first_deg: float
    last_deg: float
    levers_m: tuple[float, ...]

    def _corners(self) -> list[tuple[float, float, float]]:
        """For each angle in rad: the lever there, and its integral from the first angle."""
        first, last = math.radians(self.first_deg), math.radians(self.last_deg)
        step = (last - first) / (len(self.levers_m) - 1)
        corners, arc_m = [(first, self.levers_m[0], 0.0)], 0.0
        for place, (before_m, after_m) in enumerate(itertools.pairwise(self.levers_m), 1):
            arc_m += 0.5 * (before_m + after_m) * step
            corners.append((first + place * step, after_m, arc_m))
        return corners

    def _from_first_m(self, angle_rad: float) -> float:
        corners = self._corners()
        if angle_rad <= corners[0][0]:
            return corners[0][1] * (angle_rad - corners[0][0])
        for (at, lever_m, arc_m), (end, next_m, _) in itertools.pairwise(corners):
            if angle_rad <= end:
                turned = angle_rad - at
                return arc_m + (lever_m + 0.5 * (next_m - lever_m) / (end - at) * turned) * turned
        at, lever_m, arc_m = corners[-1]
        return arc_m + lever_m * (angle_rad - at)

    def arc_m(self, angle_rad: float) -> float:
        """The lever's integral from the angle 0."""
        return self._from_first_m(angle_rad) - self._from_first_m(0.0)

    def angle_rad(self, arc_m: float) -> float:
        """The angle at which arc_m() is this arc."""
        corners = self._corners()
        wanted_m = arc_m + self._from_first_m(0.0)
        at, lever_m, reached_m = next((corner for corner in reversed(corners) if corner[2] <= wanted_m), corners[0])
        left_m, slope = wanted_m - reached_m, 0.0
        if left_m > 0.0 and at < corners[-1][0]:
            end, next_m, _ = corners[[corner[0] for corner in corners].index(at) + 1]
            slope = (next_m - lever_m) / (end - at)
        return at + 2.0 * left_m / (lever_m + math.sqrt(lever_m**2 + 2.0 * slope * left_m))


class Joint(NamedTuple):
    """lever_m: at the angle 0; negative for the muscle that turns the joint to negative angles, whose positions have
    the opposite sign. other_node: of the muscle that turns it back; None: a spring or a weight does. table: for a
    lever that depends on the angle."""

    lever_m: float
    other_node: int | None
    table: LeverTable | None = None

    def angle_deg(self, position_m: float) -> float:
        """The joint's angle at this position of the muscle."""
        if self.table is None:
            return math.degrees(position_m / self.lever_m)
        return math.degrees(self.table.angle_rad(math.copysign(1.0, self.lever_m) * position_m))

    def position_m(self, angle_deg: float) -> float:
        """The position to command for this angle of the joint."""
        angle_rad = math.radians(angle_deg)
        if self.table is None:
            return angle_rad * self.lever_m
        return math.copysign(1.0, self.lever_m) * self.table.arc_m(angle_rad)


def joint_of(node: int, known: Mapping[Quantity, float]) -> Joint | None:
    """known: the values of QUANTITIES that a board reports. None: the muscle is in no joint."""
    lever_m, offset = known[Quantity.joint_lever_m], known[Quantity.joint_other_node_offset]
    if math.isnan(lever_m):
        return None
    levers_m = tuple(itertools.takewhile(lambda lever_m: lever_m > 0.0, (known[point] for point in _POINTS)))
    first, last = known[Quantity.joint_lever_first_rad], known[Quantity.joint_lever_last_rad]
    has_table = len(levers_m) > 1 and first <= 0.0 <= last and first < last
    table = LeverTable(math.degrees(first), math.degrees(last), levers_m) if has_table else None
    return Joint(lever_m, None if math.isnan(offset) else node + round(offset), table)
