"""How a muscle's node is reached, over any kind of connection."""

import asyncio
import contextlib
from typing import Protocol

import can

from supercoil import codec, e2e
from supercoil.bus import Bus
from supercoil.clock import Clock
from supercoil.errors import BusError, NoAnswerError
from supercoil.generated import messages, names
from supercoil.generated.names import Opcode, Quantity, Setting, Tunable, When
from supercoil.heartbeat import Heartbeat
from supercoil.playback import PlaybackSession
from supercoil.session import ANSWER_WITHIN_S
from supercoil.telemetry import Telemetry

_HEARTBEAT = frozenset((messages.STATUS, messages.EMERGENCY, messages.FIRST_CAUSE))
_ANSWERS = frozenset((messages.ACKNOWLEDGE, messages.SETTING, messages.TUNING, messages.TRAJECTORY,
                      messages.REFUSED_VALUE))
# Only these messages wake the event loop; all others are just kept.
_EVENTS = _HEARTBEAT | _ANSWERS | {messages.MUSCLE}


class Link(Protocol):
    telemetry: Telemetry
    heartbeat: Heartbeat

    async def open(self) -> None: ...
    async def close(self) -> None: ...
    async def command(self, opcode: Opcode, value: float) -> None: ...
    async def disarm(self) -> None: ...
    async def write(self, setting: Setting, value: float) -> float: ...
    async def read(self, setting: Setting) -> float: ...
    async def quantity(self, quantity: Quantity) -> float: ...
    async def prepare(self, place: int, tunable: Tunable, value: float) -> None: ...
    async def tuned(self, place: int, tunable: Tunable, of: names.Set) -> float: ...
    async def knot(self, after_s: float, position_m: float, velocity_m_per_s: float) -> messages.Trajectory: ...
    async def play(self, when: When, sync: int = 0, after_s: float = 0.0) -> messages.Trajectory: ...
    async def keep(self) -> None: ...
    async def release(self) -> None: ...
    @property
    def trajectory(self) -> messages.Trajectory: ...
    @property
    def clock(self) -> Clock: ...
    @property
    def holds_lease(self) -> bool: ...
    @property
    def lease_age_s(self) -> float: ...


class CanLink:
    def __init__(self, address: str | can.BusABC, node: int, options: dict[str, object]) -> None:
        self.telemetry = Telemetry(node)
        self.heartbeat = Heartbeat(node)
        self._address = address
        self._options = options
        self._node = node
        self._session = PlaybackSession(node, self._send)
        self._bus: Bus | None = None
        self._loop = asyncio.get_running_loop()
        self._read: dict[tuple[int, ...], list[asyncio.Future[float]]] = {}

    async def open(self) -> None:
        self._bus = await Bus.join(self._address, self._options)
        self._bus.attach(self._node, self._take)

    async def close(self) -> None:
        if self._bus is not None:
            bus, self._bus = self._bus, None
            bus.detach(self._node, self._take)
            await bus.leave()

    async def command(self, opcode: Opcode, value: float) -> None:
        await self._session.command(opcode, value)

    async def disarm(self) -> None:
        await self._session.disarm()

    async def write(self, setting: Setting, value: float) -> float:
        return await self._session.write(setting, value)

    async def read(self, setting: Setting) -> float:
        return await self._ask(messages.SETTING_READ, messages.SETTING, setting=setting)

    async def quantity(self, quantity: Quantity) -> float:
        return await self._ask(messages.MUSCLE_READ, messages.MUSCLE, quantity=quantity)

    async def prepare(self, place: int, tunable: Tunable, value: float) -> None:
        await self._session.prepare(place, tunable, value)

    async def tuned(self, place: int, tunable: Tunable, of: names.Set) -> float:
        return await self._ask(messages.TUNING_READ, messages.TUNING, place=place, tunable=tunable, set=of)

    async def knot(self, after_s: float, position_m: float, velocity_m_per_s: float) -> messages.Trajectory:
        await self._session.knot(after_s, position_m, velocity_m_per_s)
        return self.trajectory

    async def play(self, when: When, sync: int = 0, after_s: float = 0.0) -> messages.Trajectory:
        await self._session.play(when, sync, after_s)
        return self.trajectory

    async def keep(self) -> None:
        await self._session.keep()

    async def release(self) -> None:
        await self._session.release()

    @property
    def trajectory(self) -> messages.Trajectory:
        """The newest Trajectory."""
        return self._session.trajectory

    @property
    def clock(self) -> Clock:
        """The bus's clock."""
        if self._bus is None:
            raise BusError(f"node {self._node} is not connected")
        return self._bus.clock

    @property
    def holds_lease(self) -> bool:
        return self._session.holds_lease

    @property
    def lease_age_s(self) -> float:
        return self._session.lease_age_s

    async def _send(self, identifier: int, data: bytes) -> None:
        if self._bus is None:
            raise BusError(f"node {self._node} is not connected")
        await self._bus.send(identifier, data)

    async def _ask(self, request: int, answer: int, **fields: int) -> float:
        """Reads a value. Reading needs no lease, and everybody hears the answer."""
        waiting = self._read.setdefault((answer, *fields.values()), [])
        future: asyncio.Future[float] = self._loop.create_future()
        waiting.append(future)
        try:
            await self._send(request | self._node, codec.encode(codec.LAYOUTS[request], fields))
            async with asyncio.timeout(ANSWER_WITHIN_S):
                return await future
        except TimeoutError:
            requested = ", ".join(f"{signal} {value}" for signal, value in fields.items())
            raise NoAnswerError(f"node {self._node} does not report its {requested}") from None
        finally:
            waiting.remove(future)

    def _take(self, base: int, time_s: float, data: bytes) -> None:
        """Called in the bus's thread."""
        self.telemetry.take(base, time_s, data)
        if base in _EVENTS:
            with contextlib.suppress(RuntimeError):  # the loop has ended
                self._loop.call_soon_threadsafe(self._receive, base, time_s, data)

    def _receive(self, base: int, time_s: float, data: bytes) -> None:
        if base in _HEARTBEAT:
            self.heartbeat.receive_frame(base, time_s, data)
        if base in _ANSWERS:
            self._session.receive(base, data)
        if base == messages.SETTING and e2e.is_intact(base | self._node, data):
            setting = codec.decode(base, data)
            self._deliver(setting.value, base, setting.setting)
        elif base == messages.TUNING and e2e.is_intact(base | self._node, data):
            tuned = codec.decode(base, data)
            self._deliver(tuned.value, base, tuned.place, tuned.tunable, tuned.set)
        elif base == messages.MUSCLE and (muscle := codec.decode(base, data)) is not None:
            self._deliver(muscle.value, base, muscle.quantity)

    def _deliver(self, value: float, *key: int) -> None:
        for future in self._read.get(key, ()):
            if not future.done():
                future.set_result(float(f"{value:.7g}"))  # a float of 32 bits has no more digits
