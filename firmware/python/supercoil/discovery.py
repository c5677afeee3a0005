"""Finds the nodes on a bus, and stops a muscle at once."""

import asyncio
from typing import NamedTuple

import can

from supercoil import codec
from supercoil.address import is_local
from supercoil.bus import Bus
from supercoil.errors import BusError
from supercoil.generated import messages
from supercoil.generated.names import Fault, State
from supercoil.generated.version import PROTOCOL_VERSION
from supercoil.link import CanLink, Link
from supercoil.local import SocketLink
from supercoil.named import number


class Found(NamedTuple):
    """A node that was heard."""

    node: int
    state: State
    fault: Fault
    leased: bool  # a master holds its lease
    protocol_version: int

    @property
    def can_be_commanded(self) -> bool:
        """Whether it speaks this package's version of the protocol."""
        return self.protocol_version == PROTOCOL_VERSION


async def discover(address: str | can.BusABC, *, seconds: float = 1.0, **options: object) -> list[Found]:
    """Every node whose heartbeat is heard within this time. A board sends ten heartbeats a second."""
    number("seconds", seconds)
    statuses: dict[int, messages.Status] = {}

    def receive(node: int, base: int, time_s: float, data: bytes) -> None:
        if base == messages.STATUS and (status := codec.decode(base, data, time_s)) is not None:
            statuses[node] = status

    if is_local(address):
        raise BusError(f"{address}: is the socket of one board, not a bus with several")
    bus = await Bus.join(address, options)
    try:
        with bus.monitor(receive):
            await asyncio.sleep(seconds)
    finally:
        await bus.leave()
    return [Found(node, status.state, status.fault, status.leased, status.protocol_version)
            for node, status in sorted(statuses.items())]


async def stop(address: str | can.BusABC, node: int = 1, **options: object) -> None:
    """Disarms a node, whoever holds its lease and whatever version of the protocol it speaks; by the board's own socket
    a channel."""
    link: Link
    if isinstance(address, str) and is_local(address):
        link = SocketLink(address, node)
    else:
        link = CanLink(address, node, options)
    await link.open()
    try:
        await link.disarm()
    finally:
        await link.close()
