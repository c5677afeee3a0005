"""Numbers that have names in the protocol."""

import enum
from typing import Self


class Named(enum.IntEnum):
    """Of one of the DBC's tables. A number that it has no name for, of a newer board, is unknown_NUMBER."""

    @classmethod
    def _missing_(cls, value: object) -> Self | None:
        if not isinstance(value, int):
            return None
        member = int.__new__(cls, value)
        member._name_ = f"unknown_{value}"
        member._value_ = value
        return member

    def __str__(self) -> str:
        return self.name
