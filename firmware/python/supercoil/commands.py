"""The commands of a muscle."""

import asyncio
import contextlib
import time
from typing import NamedTuple

from supercoil.connection import FRESH_BEATS, HEARTBEAT_S, Connection
from supercoil.errors import NoAnswerError, NotReachedError
from supercoil.generated import messages, refusals
from supercoil.generated.names import Opcode, Quantity, Setting, State
from supercoil.joints import QUANTITIES, Joint, joint_of
from supercoil.named import duration, number, unknown

_POLL_PERIOD_S = 0.02
_SETTLED_S = 0.2


def _setting_of(setting: Setting | str) -> Setting:
    if isinstance(setting, Setting):
        return setting
    if setting in Setting.__members__:
        return Setting[setting]
    raise unknown("setting", setting, Setting.__members__)


class Order(NamedTuple):
    """One command to one muscle, for cycle()."""

    muscle: "Commands"
    opcode: Opcode
    value: float


class Commands(Connection):
    async def arm(self, timeout_s: float = 5.0) -> None:
        """Waits for a board that is not ready yet. On return, the heater is measured and ready to heat."""
        end = time.monotonic() + duration("timeout_s", timeout_s)
        while True:
            try:
                await self._obey(Opcode.arm)
                self._kept.rests()
                break
            except refusals.NotReady:
                if time.monotonic() > end:
                    raise
                await asyncio.sleep(0.1)
        heartbeat = self._link.heartbeat
        fresh_at = heartbeat.beats + FRESH_BEATS
        while heartbeat.beats < fresh_at or not (
                heartbeat.state == State.armed and heartbeat.status and heartbeat.status.state == State.armed
                and not heartbeat.status.probing):
            await heartbeat.change(HEARTBEAT_S)
            await heartbeat.raise_fault()
            if time.monotonic() > end + HEARTBEAT_S:
                raise NoAnswerError(f"node {self.node}: obeyed arm, but is {heartbeat.state}")

    async def disarm(self) -> None:
        """Switches off. Needs no lease: the board obeys it from any master."""
        self._kept.rests()
        self._kept.alive()
        await self._link.disarm()
        await self._leave(State.armed, State.active)

    async def reset(self) -> None:
        """Leaves the state fault if its cause is gone; the muscle is then disarmed."""
        self._kept.rests()
        await self._obey(Opcode.reset)
        await self._leave(State.fault)

    async def _leave(self, *states: State) -> None:
        """Waits until the heartbeat shows that the command was obeyed."""
        end = time.monotonic() + HEARTBEAT_S
        while self.state in states and time.monotonic() < end:
            await self._link.heartbeat.change(HEARTBEAT_S)

    async def set_position(self, position_m: float) -> None:
        """Holds until the next set point, rest() or the deadline. Returns at once."""
        await self._heat(Opcode.position, position_m)

    async def set_power(self, power_W: float) -> None:
        """Likewise, in open loop."""
        await self._heat(Opcode.power, power_W)

    async def move_to(self, position_m: float, *, tolerance_m: float = 2e-4, timeout_s: float = 30.0) -> None:
        """Returns when the muscle has been within the tolerance for 0.2 s. Raises at once what hold() raises."""
        number("tolerance_m", tolerance_m, 0.0)
        duration("timeout_s", timeout_s)
        await self.set_position(position_m)
        end = time.monotonic() + timeout_s
        there_since: float | None = None
        while there_since is None or time.monotonic() - there_since < _SETTLED_S:
            await self._wait_held(_POLL_PERIOD_S)
            now = time.monotonic()
            newest = self.telemetry.newest(messages.Measurement)
            near = newest is not None and abs(newest.position_m - position_m) <= tolerance_m
            there_since = (there_since or now) if near else None
            if now > end and not near:
                at = "unknown" if newest is None else f"{newest.position_m:.6f} m"
                raise NotReachedError(f"node {self.node}: not at {position_m:.6f} m within {timeout_s:g} s: at {at}")

    async def hold(self, seconds: float) -> None:
        """Waits, and meanwhile keeps the muscle where it is. Raises at once: a fault; the refusal of the renewed
        command, because another program has disarmed the muscle or taken its lease; BusError or NoAnswerError, if the
        bus or, for 2 s, the board is gone."""
        end = time.monotonic() + duration("seconds", seconds)
        self._kept.raise_if_let_go()
        while (rest := end - time.monotonic()) > 0:
            await self._wait_held(min(rest, _POLL_PERIOD_S))

    async def rest(self) -> None:
        """Active becomes armed: the muscle cools. Does nothing if it was let go or never heated: it rests already."""
        self._kept.rests()
        try:
            await self._obey(Opcode.rest)
        except refusals.WrongState:
            if self.state != State.armed:
                raise
        await self._leave(State.active)

    async def renew(self) -> None:
        """Renews the last command to heat. It is renewed in the background too, until the deadline."""
        await self._heat(Opcode.renew)

    async def setting(self, setting: Setting | str) -> float:
        return await self._link.read(_setting_of(setting))

    async def settings(self) -> dict[Setting, float]:
        """All settings of this node."""
        values = {setting: await self._link.read(setting) for setting in Setting}
        return {setting: value for setting, value in values.items() if value == value}

    async def change(self, setting: Setting | str, value: float) -> float:
        """Changes a setting until the board starts again. Returns the value that now holds."""
        which = _setting_of(setting)
        carried = number(str(which), value)
        self._kept.alive()
        return await self._link.write(which, carried)

    async def program(self) -> str:
        """The program that the board runs, "0.2.0 (2780ebf)": version, and commit unless it is a release. Boards send
        it once a second over CAN; NoAnswerError: an older board, or the board's own socket."""
        if (boot := self.telemetry.newest(messages.Boot)) is None:
            async with contextlib.aclosing(self.stream(messages.Boot)) as boots:
                boot = await anext(boots)
        commit = f" ({boot.commit:07x})" if boot.commit else ""
        return f"{boot.version_major}.{boot.version_minor}.{boot.version_patch}{commit}"

    async def quantities(self) -> dict[Quantity, float]:
        """What the board knows of its muscle and uses now; NaN: not known."""
        return {quantity: await self._link.quantity(quantity) for quantity in Quantity}

    async def joint(self) -> Joint | None:
        """The joint that the muscle turns with another muscle; None: it moves alone."""
        return joint_of(self.node, {quantity: await self._link.quantity(quantity) for quantity in QUANTITIES})

    def make_position(self, position_m: float) -> Order:
        return Order(self, Opcode.position, position_m)

    def make_power(self, power_W: float) -> Order:
        return Order(self, Opcode.power, power_W)

    def make_renew(self) -> Order:
        return Order(self, Opcode.renew, 0.0)

    def make_rest(self) -> Order:
        return Order(self, Opcode.rest, 0.0)

    async def execute(self, order: Order) -> messages.Measurement:
        """Executes an order, and returns the newest measurement."""
        if order.opcode == Opcode.rest:
            self._kept.rests()
            await self._obey(order.opcode)
        else:
            await self._heat(order.opcode, order.value)
        return self.telemetry.measurement
