"""Clocks by which several muscles start together and stay in step."""

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
        """Of a start that is still to come."""
    async def sync(self, number: int) -> None:
        """All that were told this number start."""


class BusClock:
    """The master's, one for each bus: whoever plays on it at the same time takes numbers in turn."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self._number = secrets.randbelow(_NUMBERS)

    def next_number(self) -> int:
        """Of a Sync that is still to be sent."""
        self._number = (self._number + 1) % _NUMBERS
        return self._number

    async def sync(self, number: int) -> None:
        """All boards of the bus hear it."""
        told = codec.encode(_SYNC, {"sync": number, "master_time_s": time.monotonic()})
        await self._send(_IDENTIFIER, e2e.protected(_IDENTIFIER, told))


class SocketClock:
    """Of a board that is commanded by its own socket: its channels start at one of its times."""

    _of_paths: ClassVar[weakref.WeakValueDictionary[str, "SocketClock"]] = weakref.WeakValueDictionary()

    def __init__(self) -> None:
        self._number = 0
        self._starts_s: dict[int, float] = {}

    @classmethod
    def of(cls, path: str) -> "SocketClock":
        """The same for all links to one socket."""
        return cls._of_paths.setdefault(path, cls())

    def next_number(self) -> int:
        self._number += 1
        return self._number

    def start_s(self, number: int, board_s: float, after_s: float) -> float:
        """For all of this number what it is for the first: after_s after board_s, the board's time."""
        return self._starts_s.setdefault(number, board_s + after_s)

    async def sync(self, number: int) -> None:
        """They start by themselves."""
        self._starts_s.pop(number, None)
