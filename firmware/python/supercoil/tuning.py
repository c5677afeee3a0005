"""Changes values of controllers and estimators while the board runs (docs/tuning.md)."""

import math
from collections.abc import Mapping
from typing import NamedTuple

from supercoil.codec import FIRST_ESTIMATOR, FORGET_TUNING, STORE_TUNING, TUNES_FROM
from supercoil.generated import tunables
from supercoil.generated.names import Opcode, Set, Tunable
from supercoil.learning import Learning
from supercoil.named import number, unknown

Value = float | bool | str | None
_FLAG = ("false", "true")


class Tuned(NamedTuple):
    """One value of a controller or estimator, in each set; None: that set has none."""

    name: str
    unit: str
    in_use: Value
    configured: Value  # from the board's file
    stored: Value  # for the next start
    prepared: Value  # for the next take_over()
    range: tuple[Value, ...]  # lowest and highest; for a flag or a name, all choices


class _Place(NamedTuple):
    """What is tuned: its number in the protocol, and the tunables that it may have."""

    name: str
    kind: str
    number: int
    units: Mapping[Tunable, str]
    choices: Mapping[Tunable, tuple[str, ...]]


def _place_of(controller: int, estimator: int | None) -> _Place:
    if estimator is None:
        return _Place(f"controller {controller}", "a controller", controller, tunables.CONTROLLER_UNITS,
                      tunables.CONTROLLER_CHOICES)
    if controller != 0:
        raise ValueError("controller and estimator: tune one of them")
    return _Place(f"estimator {estimator}", "an estimator", FIRST_ESTIMATOR + estimator, tunables.ESTIMATOR_UNITS,
                  tunables.ESTIMATOR_CHOICES)


def _value_of(choices: tuple[str, ...] | None, number: float) -> Value:
    if math.isnan(number):
        return None
    if choices is None:
        return number
    place = int(number)
    if choices == _FLAG:
        return bool(place)
    return choices[place] if place < len(choices) else str(place)  # from a newer board


def _number_of(tunable: Tunable, choices: tuple[str, ...] | None, value: float | str) -> float:
    if isinstance(value, str):
        if choices is None or choices == _FLAG:
            raise ValueError(f"{tunable} = {value!r}: must be {'a number' if choices is None else 'True or False'}")
        if value not in choices:
            raise unknown(str(tunable), value, choices)
        return choices.index(value)
    if choices is not None and choices != _FLAG:
        raise ValueError(f"{tunable} = {value}: must be one of {', '.join(choices)}")
    return number(str(tunable), value)


def _tunable_of(place: _Place, name: str) -> Tunable:
    if name in Tunable.__members__ and Tunable[name] in place.units:
        return Tunable[name]
    raise unknown(f"value of {place.kind}", name, map(str, place.units))


def _set_of(name: str) -> Set:
    if name in Set.__members__:
        return Set[name]
    raise unknown("set of values", name, Set.__members__)


class Tuning(Learning):
    async def tuning(self, controller: int = 0, *, estimator: int | None = None) -> dict[str, Tuned]:
        """All values of this controller, by name, or of this estimator. Both: places in the configuration, from 0."""
        place = _place_of(controller, estimator)
        result = {}
        for tunable, unit in place.units.items():
            choices = place.choices.get(tunable)
            values = {}
            for each in Set:
                self._kept.alive()
                values[each.name] = _value_of(choices, await self._link.tuned(place.number, tunable, each))
            if any(value is not None for value in values.values()):
                allowed: tuple[Value, ...] = choices or tunables.RANGES[tunable]
                if choices == _FLAG:
                    allowed = (False, True)
                result[str(tunable)] = Tuned(str(tunable), unit, range=allowed, **values)
            if not result:
                raise ValueError(f"node {self.node} has no {place.name} that can be tuned")
        return result

    async def tune(self, controller: int = 0, *, estimator: int | None = None, base: str = "in_use",
                   **values: float | str) -> None:
        """Takes effect at once: a controller without a jump of the power; an estimator starts from scratch. base: the
        set in which the values are changed; "configured" undoes changes. A refusal changes nothing that is in use."""
        await self.prepare(controller, estimator=estimator, base=base, **values)
        await self.take_over(controller, estimator=estimator)

    async def prepare(self, controller: int = 0, *, estimator: int | None = None, base: str = "in_use",
                      **values: float | str) -> None:
        """Does the same for a later take_over(): nothing changes yet."""
        place = _place_of(controller, estimator)
        wanted = {}
        for name, value in values.items():
            tunable = _tunable_of(place, name)
            wanted[tunable] = _number_of(tunable, place.choices.get(tunable), value)
        self._kept.alive()
        await self._link.prepare(place.number, Tunable.all, _set_of(base))
        for tunable in sorted(wanted):  # the values depend on the kind, and the poles on the model
            await self._link.prepare(place.number, tunable, wanted[tunable])

    async def take_over(self, controller: int = 0, *, estimator: int | None = None) -> None:
        """Takes the prepared values into use."""
        await self._obey(Opcode.controller, TUNES_FROM + _place_of(controller, estimator).number)

    async def store_tuning(self) -> None:
        """Stores the values in use, and which controller and estimator are chosen, for the next start."""
        await self._obey(Opcode.store, STORE_TUNING)

    async def forget_tuning(self) -> None:
        """The next start uses the board's file."""
        await self._obey(Opcode.store, FORGET_TUNING)
