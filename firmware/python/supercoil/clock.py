"""The master's clock, by which boards of one bus start together and stay in step."""

import secrets
import time

from supercoil import codec, e2e
from supercoil.generated import messages
from supercoil.session import Send

_SYNC = codec.LAYOUTS[messages.SYNC]
_IDENTIFIER = messages.SYNC | 1
_NUMBERS = 256


class Clock:
    """One for each bus: whoever plays on it at the same time takes numbers in turn."""

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
