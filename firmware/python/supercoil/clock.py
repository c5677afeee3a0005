"""Clocks that start several muscles together and keep them in step."""

import secrets
import time
import weakref
from typing import ClassVar, Protocol

from supercoil import codec, e2e
from supercoil.generated import messages
from supercoil.session import Send

_SYNC = codec.LAYOUTS[messages.SYNC]
_IDENTIFIER = messages.SYNC | 1
_NUMBERS = 256


class Clock(Protocol):
    def next_number(self) -> int:
        """The number of a start that is still to come."""
    async def sync(self, number: int) -> None:
        """Starts all muscles that were given this number."""


class BusClock:
    """The master's clock, one for each bus: all players that use the bus at the same time take numbers in turn."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self._number = secrets.randbelow(_NUMBERS)

    def next_number(self) -> int:
        """The number of a Sync that is still to be sent."""
        self._number = (self._number + 1) % _NUMBERS
        return self._number

    async def sync(self, number: int) -> None:
        """Sends a Sync that all boards of the bus hear."""
        data = codec.encode(_SYNC, {"sync": number, "master_time_s": time.monotonic()})
        await self._send(_IDENTIFIER, e2e.protected(_IDENTIFIER, data))


class SocketClock:
    """The clock of a board that is commanded over its own socket: its channels start at a time of the board."""

    _of_paths: ClassVar[weakref.WeakValueDictionary[str, "SocketClock"]] = weakref.WeakValueDictionary()

    def __init__(self) -> None:
        self._number = 0
        self._starts_s: dict[int, float] = {}

    @classmethod
    def of(cls, path: str) -> "SocketClock":
        """The clock shared by all links to one socket."""
        return cls._of_paths.setdefault(path, cls())

    def next_number(self) -> int:
        self._number += 1
        return self._number

    def start_s(self, number: int, board_s: float, after_s: float) -> float:
        """The same start time for all that use this number: after_s after the first caller's board_s, in board time."""
        return self._starts_s.setdefault(number, board_s + after_s)

    async def sync(self, number: int) -> None:
        """Nothing to do: the channels start by themselves."""
        self._starts_s.pop(number, None)
