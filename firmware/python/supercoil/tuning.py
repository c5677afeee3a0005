"""The values of a controller, changed while the board runs (docs/tuning.md)."""

import math
from typing import NamedTuple

from supercoil.codec import FORGET_TUNING, STORE_TUNING, TUNES_FROM
from supercoil.generated.names import Opcode, Set, Tunable
from supercoil.generated.tunables import CHOICES, RANGES, UNITS
from supercoil.learning import Learning
from supercoil.named import unknown

Value = float | bool | str | None
_FLAG = ("false", "true")


class Tuned(NamedTuple):
    """One value of a controller, in each set; None: it has none there."""

    name: str
    unit: str
    in_use: Value
    configured: Value  # by the board's file
    stored: Value  # for the next start
    prepared: Value  # for the next take_over()
    range: tuple[Value, ...]  # lowest and highest; of a flag or a name all that it may be


def _value_of(tunable: Tunable, told: float) -> Value:
    if math.isnan(told):
        return None
    choices = CHOICES.get(tunable)
    if choices is None:
        return told
    place = int(told)
    if choices == _FLAG:
        return bool(place)
    return choices[place] if place < len(choices) else str(place)  # of a newer board


def _number_of(tunable: Tunable, value: float | str) -> float:
    choices = CHOICES.get(tunable)
    if isinstance(value, str):
        if choices is None or choices == _FLAG:
            raise ValueError(f"{tunable} = {value!r}: must be {'a number' if choices is None else 'True or False'}")
        if value not in choices:
            raise unknown(str(tunable), value, choices)
        return choices.index(value)
    if choices is not None and choices != _FLAG:
        raise ValueError(f"{tunable} = {value}: must be one of {', '.join(choices)}")
    return float(value)


def _tunable_of(name: str) -> Tunable:
    if name in Tunable.__members__ and Tunable[name] in UNITS:
        return Tunable[name]
    raise unknown("value of a controller", name, map(str, UNITS))


def _set_of(name: str) -> Set:
    if name in Set.__members__:
        return Set[name]
    raise unknown("set of values", name, Set.__members__)


class Tuning(Learning):
    async def tuning(self, controller: int = 0) -> dict[str, Tuned]:
        """All that this controller has, by name. controller: its place in the configuration, from 0."""
        told = {}
        for tunable, unit in UNITS.items():
            values = {}
            for each in Set:
                self._kept.alive()
                values[each.name] = _value_of(tunable, await self._link.tuned(controller, tunable, each))
            if any(value is not None for value in values.values()):
                choices = CHOICES.get(tunable)
                allowed = RANGES[tunable] if choices is None else (False, True) if choices == _FLAG else choices
                told[str(tunable)] = Tuned(str(tunable), unit, range=allowed, **values)
            if not told:
                raise ValueError(f"node {self.node} has no controller {controller} that can be tuned")
        return told

    async def tune(self, controller: int = 0, *, base: str = "in_use", **values: float | str) -> None:
        """Used from now on, without a jump of the power. base: the set that the values are changed in; "configured" is
        the way back. What is refused changes nothing that is in use."""
        await self.prepare(controller, base=base, **values)
        await self.take_over(controller)

    async def prepare(self, controller: int = 0, *, base: str = "in_use", **values: float | str) -> None:
        """The same for a later take_over(): nothing changes yet."""
        wanted = {(tunable := _tunable_of(name)): _number_of(tunable, value) for name, value in values.items()}
        self._kept.alive()
        await self._link.prepare(controller, Tunable.all, _set_of(base))
        for tunable in sorted(wanted):  # what there is depends on the kind, and the poles on the model
            await self._link.prepare(controller, tunable, wanted[tunable])

    async def take_over(self, controller: int = 0) -> None:
        """Uses what was prepared."""
        await self._obey(Opcode.controller, TUNES_FROM + controller)

    async def store_tuning(self) -> None:
        """Keeps what is in use, and which controller and estimator are chosen, for the next start."""
        await self._obey(Opcode.store, STORE_TUNING)

    async def forget_tuning(self) -> None:
        """The next start goes by the board's file."""
        await self._obey(Opcode.store, FORGET_TUNING)
