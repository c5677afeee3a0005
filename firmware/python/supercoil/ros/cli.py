"""supercoil-ros: the command."""

import argparse
import asyncio
import dataclasses
import logging
import os
import signal
import sys
from collections.abc import Callable, Sequence
from importlib.util import find_spec

from supercoil.errors import SupercoilError
from supercoil.generated.version import __version__
from supercoil.ros.options import Options

_NODES = range(1, 64)
_DOMAINS = range(233)  # higher ones have no port of their own


def _joint(text: str) -> tuple[str, int]:
    from supercoil.ros.names import checked
    name, equals, node = text.partition("=")
    if not equals or not node.isdecimal() or int(node) not in _NODES:
        raise argparse.ArgumentTypeError(f"{text}: must be NAME=NODE, with a node of 1 to 63, as finger=1")
    try:
        return checked(name, "joint"), int(node)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _number(low: float, high: float, unit: str) -> Callable[[str], float]:
    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = float("nan")
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text}: must be {low:g} to {high:g} {unit}")
        return value
    return read


def _domain(text: str) -> int:
    if not text.isdecimal() or int(text) not in _DOMAINS:
        raise argparse.ArgumentTypeError(f"{text}: must be 0 to {_DOMAINS[-1]}")
    return int(text)


def _arguments(given: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="supercoil-ros", formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Muscles as joints of ROS 2, over DDS as rmw_cyclonedds_cpp speaks it. No ROS is needed on this "
        "machine.\nPositions are in metres, or, for two muscles that turn a joint, in radians.",
        epilog="The muscles are disarmed when it ends, and cool by themselves when it is killed. Everything is "
        "described by ros in `supercoil docs`.")
    parser.add_argument("address", help="address of the boards: can0, socketcand:[HOST:]PORT, INTERFACE:CHANNEL of "
                        "python-can, or the path of the board's own socket")
    parser.add_argument("--joint", metavar="NAME=NODE", action="append", required=True, type=_joint,
                        help="a muscle and its node on the bus; repeat for each. For two that turn a "
                        "joint, the agonist")
    parser.add_argument("--arm", action="store_true",
                        help="arm each muscle when its board is first reached; otherwise the service ~/arm does")
    parser.add_argument("--rate", metavar="HZ", dest="rate_Hz", type=_number(1.0, 1000.0, "Hz"),
                        default=Options.rate_Hz, help="rate of joint states and of set points (default: %(default)g)")
    parser.add_argument("--command-timeout", metavar="S", dest="command_timeout_s", type=_number(0.05, 3600.0, "s"),
                        default=Options.command_timeout_s, help="how long a joint command holds (default: %(default)g)")
    for topic in ("states", "commands", "trajectory"):
        parser.add_argument(f"--{topic}", metavar="TOPIC", default=getattr(Options, topic), help="default: %(default)s")
    parser.add_argument("--name", dest="node", default=Options.node,
                        help="name of the node, which ~ stands for (default: %(default)s)")
    parser.add_argument("--domain", metavar="N", type=_domain,
                        default=os.environ.get("ROS_DOMAIN_ID") or str(Options.domain),
                        help="DDS domain (default: ROS_DOMAIN_ID, or 0)")
    parser.add_argument("--version", action="version", version=f"supercoil-ros {__version__}")
    arguments = list(sys.argv[1:] if given is None else given)
    if "--ros-args" in arguments:  # a launch file of ROS adds it, followed by its own arguments
        del arguments[arguments.index("--ros-args"):]
    read = parser.parse_args(arguments)
    names = [name for name, _ in read.joint]
    nodes = [node for _, node in read.joint]
    for kept, what in ((names, "name"), (nodes, "node")):
        twice = {str(each) for each in kept if kept.count(each) > 1}
        if twice:
            parser.error(f"--joint: {what} {', '.join(sorted(twice))} is given twice")
    return read


async def _run(read: argparse.Namespace) -> None:
    from supercoil.ros.bridge import Bridge
    from supercoil.ros.joint import Joint
    joints = [Joint(name, read.address, node) for name, node in read.joint]
    bridge = Bridge(joints, Options(**{one.name: getattr(read, one.name) for one in dataclasses.fields(Options)}))
    running = asyncio.create_task(bridge.run())
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        asyncio.get_running_loop().add_signal_handler(number, running.cancel)
    try:
        await running
    except asyncio.CancelledError:
        if not running.cancelled():
            raise


def main(given: Sequence[str] | None = None) -> int:
    """0: it was ended; 1: could not run; 2: wrong arguments, as by argparse."""
    read = _arguments(given)
    logging.basicConfig(format="supercoil-ros: %(message)s", level=logging.INFO)
    if find_spec("cyclonedds") is None:
        print('supercoil-ros: needs Eclipse Cyclone DDS: pip install "supercoil[ros]"', file=sys.stderr)
        return 1
    from cyclonedds.core import DDSException
    try:
        asyncio.run(_run(read))
    except (SupercoilError, ValueError, DDSException) as error:
        print(f"supercoil-ros: {error}", file=sys.stderr)
        return 1
    return 0
