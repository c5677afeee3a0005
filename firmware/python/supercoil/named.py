"""Numbers that have names in the protocol, and errors for names that it does not have."""

import difflib
import enum
import math
from collections.abc import Iterable
from typing import Self


class Named(enum.IntEnum):
    """Names from one of the DBC's tables. A number without a name, from a newer board, is unknown_NUMBER."""

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


def number(what: str, value: object, least: float = -math.inf) -> float:
    """The value of an argument, which may be any kind of number, also numpy's, but must be finite."""
    try:
        if isinstance(value, str | bytes):
            raise TypeError
        carried = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise TypeError(f"{what} is {value!r}; it must be a number") from None
    if not math.isfinite(carried):
        raise ValueError(f"{what} is {carried}; it must be a finite number")
    if carried < least:
        raise ValueError(f"{what} is {carried:g}; it must be {least:g} or more")
    return carried


def duration(what: str, value: object) -> float:
    """Likewise, in s; math.inf is without end."""
    return math.inf if value == math.inf else number(what, value)


def unknown(what: str, name: str, known: Iterable[str]) -> ValueError:
    """what: "message"; the error names the one that was probably meant, or all."""
    names = list(known)
    near = difflib.get_close_matches(name, names, 1)
    instead = f"did you mean {near[0]}?" if near else f"there are {', '.join(names)}"
    return ValueError(f"no {what} is called {name!r}; {instead}")
