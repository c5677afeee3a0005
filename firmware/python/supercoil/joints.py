"""The joint that a muscle turns, with another one that turns it back."""

import math
from typing import NamedTuple


class Joint(NamedTuple):
    """lever_m: below 0 of the muscle that turns it to negative angles, whose positions have the other sign."""

    lever_m: float
    other_node: int

    def angle_deg(self, position_m: float) -> float:
        """Of the joint, at this position of the muscle."""
        return math.degrees(position_m / self.lever_m)

    def position_m(self, angle_deg: float) -> float:
        """What the muscle is commanded to, for this angle of the joint."""
        return math.radians(angle_deg) * self.lever_m


def joint_of(node: int, lever_m: float, other_node: float) -> Joint | None:
    """From what a board tells; None: the muscle is in no joint."""
    return None if math.isnan(lever_m) or math.isnan(other_node) else Joint(lever_m, node + round(other_node))
