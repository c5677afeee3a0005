"""One python-can bus, shared by all muscles on it. A thread of its own reads it."""

import asyncio
import contextlib
import threading
import time
from collections.abc import Callable, Iterator

import can

from supercoil import codec
from supercoil.address import has_ended, open_bus
from supercoil.clock import BusClock
from supercoil.errors import BusError

Take = Callable[[int, float, bytes], None]  # base, time in seconds, data

_POLL_PERIOD_S = 0.2
_SEND_WITHIN_S = 0.5
_NAP_S = 0.001


class Bus:
    """A node's take is called in the bus's thread, for each of the node's frames."""

    _shared: dict[tuple[object, object], "Bus"] = {}  # noqa: RUF012

    def __init__(self, key: tuple[object, object], bus: can.BusABC, owned: bool) -> None:
        self._key = key
        self._bus = bus
        self._owned = owned
        self._users = 0
        self._nodes: dict[int, tuple[Take, ...]] = {}
        self._monitors: list[Callable[[int, int, float, bytes], None]] = []
        self._closing = False
        self._failure: str | None = None
        self.clock = BusClock(self.send)
        self._thread = threading.Thread(target=self._read, name="supercoil bus", daemon=True)
        self._thread.start()

    @classmethod
    async def join(cls, address: str | can.BusABC, options: dict[str, object]) -> "Bus":
        """The bus of this address, opened unless this event loop has it open. Must be left as often as joined."""
        if not isinstance(address, str | can.BusABC):
            raise TypeError(f"address is {address!r}; it must be text, or a bus of python-can")
        loop = asyncio.get_running_loop()
        key = (loop, address if isinstance(address, str) else id(address))
        cls._remove_unused()
        if key not in cls._shared:
            bus = await asyncio.to_thread(open_bus, address, options) if isinstance(address, str) else address
            if key in cls._shared:  # another task was faster
                bus.shutdown()
            else:
                cls._shared[key] = cls(key, bus, isinstance(address, str))
        joined = cls._shared[key]
        joined._users += 1
        return joined

    @classmethod
    def _remove_unused(cls) -> None:
        """Drops buses that are broken, or whose event loop was closed before they were left."""
        for key, shared in list(cls._shared.items()):
            abandoned = isinstance(key[0], asyncio.AbstractEventLoop) and key[0].is_closed()
            if abandoned or shared._failure:
                shared._closing = shared._closing or abandoned
                del cls._shared[key]

    async def leave(self) -> None:
        self._users -= 1
        if self._users > 0:
            return
        if self._shared.get(self._key) is self:
            del self._shared[self._key]
        self._closing = True
        await asyncio.to_thread(self._thread.join)
        if self._owned:
            self._bus.shutdown()

    def attach(self, node: int, take: Take) -> None:
        self._nodes[node] = (*self._nodes.get(node, ()), take)

    def detach(self, node: int, take: Take) -> None:
        self._nodes[node] = tuple(one for one in self._nodes[node] if one != take)

    @contextlib.contextmanager
    def monitor(self, listener: Callable[[int, int, float, bytes], None]) -> Iterator[None]:
        """Calls listener(node, base, time_s, data) for the frames of all nodes."""
        self._monitors.append(listener)
        try:
            yield
        finally:
            self._monitors.remove(listener)

    async def send(self, identifier: int, data: bytes) -> None:
        """Waits while the bus does not accept frames."""
        frame = can.Message(arbitration_id=identifier, data=data, is_extended_id=False, check=False)
        end = time.monotonic() + _SEND_WITHIN_S
        while True:
            if self._failure:
                raise BusError(self._failure)
            try:
                return self._bus.send(frame)
            except (can.CanError, OSError) as error:
                if time.monotonic() > end:
                    raise BusError(f"cannot send on the bus: {error}") from error
            await asyncio.sleep(_NAP_S)

    def _read(self) -> None:
        try:
            while not self._closing:
                if (frame := self._bus.recv(_POLL_PERIOD_S)) is not None:
                    self._take(frame)
                elif has_ended(self._bus):
                    self._failure = "the bus is gone: the server has closed the connection"
                    return
        except (can.CanError, OSError, ValueError) as error:
            if not self._closing:
                self._failure = f"the bus is gone: {error}"

    def _take(self, frame: can.Message) -> None:
        if frame.is_extended_id or frame.is_error_frame or frame.is_remote_frame:
            return
        identifier = frame.arbitration_id
        node, base = identifier & codec.NODE_MASK, identifier & codec.BASE_MASK
        for listener in self._monitors:
            listener(node, base, frame.timestamp, bytes(frame.data))
        for take in self._nodes.get(node, ()):
            take(base, frame.timestamp, bytes(frame.data))
