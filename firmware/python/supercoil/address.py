"""How a board is reached: by a CAN bus of python-can, or by the board's own socket."""

import logging
import re
import socket

import can
from can.interfaces.socketcand import socketcand

from supercoil.errors import BusError

_SOCKETCAND = re.compile(r"socketcand:(?:(?P<host>.+):)?(?P<port>\d+)(?:/(?P<channel>[^ <>/]+))?")
_CONNECT_WITHIN_S = 5.0
_GREETED_WITHIN_S = 10.0
_TRIES = 5
_FIRST_RELIABLE = (4, 4)

# python-can warns of every frame that TCP delivers in two parts; none is lost.
logging.getLogger("can.interfaces.socketcand.socketcand").setLevel(logging.ERROR)


def _is_reliable() -> bool:
    """Whether this python-can's socketcand is. Debian 13's 4.5 calls itself 0.0.0, so a feature of 4.4 decides then."""
    if can.__version__ == "0.0.0":
        return hasattr(socketcand, "detect_beacon")
    return tuple(int(number) for number in re.findall(r"\d+", can.__version__)[:2]) >= _FIRST_RELIABLE


def is_local(address: object) -> bool:
    """Whether the address is the socket of the board's own supercoild."""
    return isinstance(address, str) and address.startswith(("/", "./", "../"))


def _open_socketcand(host: str, port: int, channel: str) -> can.BusABC:
    if not _is_reliable():
        raise BusError(f"socketcand needs python-can 4.4 or newer, this is {can.__version__}: older ones lose frames "
                       "that TCP delivers in two parts")
    # If nobody listens, python-can retries for 10 s without a pause; if nobody speaks, it waits without end.
    try:
        with socket.create_connection((host, port), _CONNECT_WITHIN_S) as tried:
            tried.settimeout(_GREETED_WITHIN_S)
            tried.recv(1)
    except OSError as error:
        raise BusError(f"socketcand on {host}:{port}: {error}") from error
    # It needs each answer alone in one read, and fails if it was kept from reading.
    for attempt in range(_TRIES):
        try:
            return can.Bus(interface="socketcand", host=host, port=port, channel=channel, tcp_tune=True)
        except can.CanError:
            if attempt + 1 == _TRIES:
                raise
    raise AssertionError


def open_bus(address: str, options: dict[str, object]) -> can.BusABC:
    """can0; socketcand:[HOST:]PORT[/INTERFACE], as for supercoil --can; or any INTERFACE:CHANNEL of python-can."""
    try:
        if found := _SOCKETCAND.fullmatch(address):
            return _open_socketcand(found["host"] or "127.0.0.1", int(found["port"]), found["channel"] or "can0")
        interface, colon, channel = address.partition(":")
        if interface == "socketcand" and "port" not in options:
            raise ValueError("must be socketcand:[HOST:]PORT[/INTERFACE], for example socketcand:29536")
        if not colon:
            interface, channel = "socketcan", address
        number = int(channel) if channel.isdecimal() else channel  # numbered devices
        return can.Bus(interface=interface, channel=number, **options)  # type: ignore[arg-type]
    except (can.CanError, OSError, ValueError, ImportError, TypeError) as error:
        raise BusError(f"{address}: {error}") from error


def has_ended(bus: can.BusABC) -> bool:
    """Whether a socketcand server has closed the connection, which python-can ignores in a busy loop."""
    connection = getattr(bus, "_SocketCanDaemonBus__socket", None)
    if not isinstance(connection, socket.socket):
        return False
    try:
        return connection.recv(1, socket.MSG_PEEK | socket.MSG_DONTWAIT) == b""
    except BlockingIOError:
        return False
    except OSError:
        return True
