"""A connection to one muscle's node: its start, its end, and what the node reports."""

import asyncio
import contextlib
import math
import time
from collections.abc import AsyncGenerator
from types import TracebackType
from typing import Any, Self, TypeVar

import can

from supercoil import codec
from supercoil.address import is_local
from supercoil.errors import BusError, NoAnswerError, VersionMismatchError
from supercoil.generated import refusals
from supercoil.generated.names import Fault, Opcode, State
from supercoil.generated.version import PROTOCOL_VERSION
from supercoil.keeper import Keeper
from supercoil.link import CanLink, Link
from supercoil.local import SocketLink
from supercoil.named import number
from supercoil.recording import Recording
from supercoil.telemetry import Telemetry, base_of

M = TypeVar("M", bound=tuple[Any, ...])

_NODES = range(1, 64)
_FIRST_HEARTBEAT_S = 2.0
HEARTBEAT_S = 2.0
# Before this many heartbeats have come, the newest may be an old one that waited in the board's queue.
FRESH_BEATS = 2
# As its value is called in the methods' signatures.
_ARGUMENTS = {Opcode.position: "position_m", Opcode.power: "power_W", Opcode.scale: "true_position_m",
              Opcode.controller: "place", Opcode.estimator: "place"}
_LEAST = {Opcode.power: 0.0}


class Connection:
    def __init__(self, address: str | can.BusABC, node: int = 1, *, deadline_s: float = 2.0, **options: object) -> None:
        """address: can0; socketcand:[HOST:]PORT; any INTERFACE:CHANNEL of python-can, which gets the options; a bus of
        python-can; or the path of the board's own socket: node is then the channel. deadline_s: how long the muscle is
        kept where it is while the program is silent."""
        if node not in _NODES:
            raise ValueError(f"node {node!r}: must be a whole number, 1 to 63")
        if not number("deadline_s", deadline_s) > 0:
            raise ValueError(f"deadline_s {deadline_s}: must be above 0")
        self.node = node
        self.deadline_s = deadline_s
        self._address = address
        self._options = options
        self._open_link: Link | None = None
        self._keeper: Keeper | None = None

    async def connect(self) -> Self:
        """Waits for the board's heartbeat, and compares versions."""
        link: Link
        if isinstance(self._address, str) and is_local(self._address):
            link = SocketLink(self._address, self.node)
        else:
            link = CanLink(self._address, self.node, self._options)
        await link.open()
        try:
            await self._shake_hands(link)
        except BaseException:
            await link.close()
            raise
        self._open_link = link
        self._keeper = Keeper(link, self.node, self.deadline_s)
        self._keeper.start()
        return self

    async def _shake_hands(self, link: Link) -> None:
        heartbeat = link.heartbeat
        end = time.monotonic() + _FIRST_HEARTBEAT_S
        while heartbeat.status is None:
            try:
                await heartbeat.change(max(0.0, end - time.monotonic()))
            except NoAnswerError:
                raise NoAnswerError(
                    f"no heartbeat from node {self.node} on {self._address} within {_FIRST_HEARTBEAT_S:g} s. Is the "
                    "board on, its node and bit rate right? For what to check see can in `supercoil docs`") from None
        if heartbeat.status.protocol_version != PROTOCOL_VERSION:
            raise VersionMismatchError(self.node, heartbeat.status.protocol_version)

    async def close(self) -> None:
        """Disarms the muscle if it was commanded, and releases the lease."""
        if self._open_link is None:
            return
        keeper = self._kept
        link, self._open_link = self._open_link, None
        try:
            await keeper.end()
        finally:
            await link.close()

    async def __aenter__(self) -> Self:
        return await self.connect()

    async def __aexit__(self, kind: type[BaseException] | None, error: BaseException | None,
                        trace: TracebackType | None) -> None:
        with contextlib.suppress(NoAnswerError, BusError) if error is not None else contextlib.nullcontext():
            await self.close()

    @property
    def _link(self) -> Link:
        if self._open_link is None:
            raise self._not_connected()
        return self._open_link

    @property
    def _kept(self) -> Keeper:
        if self._open_link is None or self._keeper is None:
            raise self._not_connected()
        return self._keeper

    def _not_connected(self) -> RuntimeError:
        return RuntimeError(f"node {self.node} is not connected: use 'with' ('async with' in asyncio), or connect()")

    @property
    def telemetry(self) -> Telemetry:
        """The newest value of everything that the board sends."""
        return self._link.telemetry

    @property
    def state(self) -> State:
        return self._link.heartbeat.state

    @property
    def fault(self) -> Fault:
        """The first cause of the state fault, or Fault.none."""
        return self._link.heartbeat.fault

    @property
    def position_m(self) -> float:
        """The position; NaN: no fresh reading."""
        return self.telemetry.measurement.position_m

    def record(self, *kinds: type[Any] | str, most_frames: int | None = None) -> Recording:
        """with muscle.record() as recording: ... keeps every message, or those of the named kinds; only the newest
        most_frames if that is given."""
        return Recording(self.telemetry, tuple(base_of(kind) for kind in kinds), most_frames)

    async def stream(self, kind: type[M]) -> AsyncGenerator[M, None]:
        """Yields each message of one kind from now on. A program that takes them does not count as silent."""
        loop = asyncio.get_running_loop()
        queue: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue()
        wanted = base_of(kind)

        def listen(base: int, time_s: float, data: bytes) -> None:
            if base == wanted:
                with contextlib.suppress(RuntimeError):
                    loop.call_soon_threadsafe(queue.put_nowait, (time_s, data))

        self.telemetry.listen(listen)
        try:
            while True:
                try:
                    async with asyncio.timeout(HEARTBEAT_S):
                        time_s, data = await queue.get()
                except TimeoutError:
                    raise NoAnswerError(f"node {self.node}: no {kind.__name__} within {HEARTBEAT_S:g} s") from None
                self._kept.alive()
                if (message := codec.decode(wanted, data, time_s)) is not None:
                    yield message
        finally:
            self._link.telemetry.forget(listen)

    async def _obey(self, opcode: Opcode, value: float = 0.0) -> None:
        """Raises a refusal because of a fault as that fault."""
        carried = number(_ARGUMENTS.get(opcode, opcode.name), value, _LEAST.get(opcode, -math.inf))
        self._kept.alive()
        try:
            await self._link.command(opcode, carried)
            self._kept.commanded()
        except refusals.WrongState:
            await self._wait_for_fault()
            if opcode != Opcode.reset:
                await self._link.heartbeat.raise_fault()
            raise

    async def _wait_for_fault(self) -> None:
        """Waits for the report of a fault that the board's answer may have overtaken."""
        if self.fault == Fault.none:
            with contextlib.suppress(NoAnswerError):
                await self._link.heartbeat.change(HEARTBEAT_S)

    async def _heat(self, opcode: Opcode, value: float = 0.0) -> None:
        self._kept.raise_if_let_go()
        await self._obey(opcode, value)
        self._kept.heats()

    async def _wait(self, seconds: float) -> None:
        self._kept.alive()
        await asyncio.sleep(seconds)
        await self._link.heartbeat.raise_fault()
        self._kept.raise_if_let_go()

    async def _wait_held(self, seconds: float) -> None:
        """Also raises why the board no longer obeys the last command to heat."""
        await self._wait(seconds)
        if (lost := self._kept.lost) is not None:
            if isinstance(lost, refusals.WrongState):
                await self._wait_for_fault()
                await self._link.heartbeat.raise_fault()
            raise lost
