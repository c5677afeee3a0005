"""What a node's heartbeats and emergencies report, and waiting for them."""

import asyncio
import contextlib
import math

from supercoil import codec
from supercoil.errors import FaultError, NoAnswerError, UnknownFaultError
from supercoil.generated import faults, messages
from supercoil.generated.names import Fault, State

# FirstCause follows its Emergency at once.
_CAUSE_WITHIN_S = 0.05


class Heartbeat:
    """Used in the event loop's thread only."""

    def __init__(self, node: int) -> None:
        self.node = node
        self.status: messages.Status | None = None
        self.beats = 0
        self.state = State.disarmed
        self.fault = Fault.none
        self._cause: messages.FirstCause | None = None
        self._changed = asyncio.Event()

    def receive(self, message: messages.Status | messages.Emergency | messages.FirstCause) -> None:
        if isinstance(message, messages.FirstCause):
            self._cause = message
        else:
            if message.fault != self.fault:
                self._cause = None
            self.state, self.fault = message.state, message.fault
        if isinstance(message, messages.Status):
            self.status = message
            self.beats += 1
        self._changed.set()
        self._changed = asyncio.Event()

    def receive_frame(self, base: int, time_s: float, data: bytes) -> None:
        if (message := codec.decode(base, data, time_s)) is not None:
            self.receive(message)

    async def change(self, within_s: float) -> None:
        """Waits until the node reports anything."""
        try:
            async with asyncio.timeout(within_s):
                await self._changed.wait()
        except TimeoutError:
            raise NoAnswerError(f"node {self.node}: no heartbeat within {within_s:g} s") from None

    async def raise_fault(self) -> None:
        """Raises the latched fault, if any."""
        if not self.is_in_fault():
            return
        if self._cause is None:
            with contextlib.suppress(NoAnswerError):
                await self.change(_CAUSE_WITHIN_S)
        if self.is_in_fault():
            raise self.error()

    def is_in_fault(self) -> bool:
        return self.fault != Fault.none

    def error(self) -> FaultError:
        """The exception for the latched fault."""
        kind = faults.BY_NUMBER.get(self.fault, UnknownFaultError)
        cause = self._cause
        return kind(self.node, cause.measured, cause.limit) if cause else kind(self.node, math.nan, math.nan)
