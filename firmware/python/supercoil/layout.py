"""How signals lie in a frame: as the DBC defines it, without anything of CAN itself."""

import enum
from typing import Any, NamedTuple


class Raw(enum.Enum):
    unsigned = "unsigned"
    signed = "signed"
    floating = "floating"


class Signal(NamedTuple):
    name: str
    unit: str
    start: int
    length: int
    raw: Raw
    scale: float
    not_available: int | None  # the raw value that means it
    selected_by: int | None  # the value of the first signal with which this one is in the frame
    type: type[float]  # of the decoded value: float, int, bool or one of generated.names

    @property
    def mask(self) -> int:
        return (1 << self.length) - 1

    @property
    def steps(self) -> int:
        """Steps per unit. Dividing by them gives the float nearest to the decimal number; times the scale would not."""
        return round(1 / self.scale)


class Layout(NamedTuple):
    type: Any  # a NamedTuple of generated.messages
    base: int
    length: int
    cycle_ms: int
    from_board: bool
    signals: tuple[Signal, ...]

    @property
    def name(self) -> str:
        return str(self.type.__name__)
