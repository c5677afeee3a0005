"""What a node has sent: the newest message of each kind, and for multiplexed ones, the newest of each value."""

from collections.abc import Callable
from typing import Any, TypeVar

from supercoil import codec
from supercoil.errors import NoAnswerError
from supercoil.generated import messages, names
from supercoil.named import unknown

M = TypeVar("M", bound=tuple[Any, ...])
Listener = Callable[[int, float, bytes], None]

# The first signal begins with the first bit and says which value a frame carries; this is the mask of its bits.
_ROUNDS = {base: codec.LAYOUTS[base].signals[0].mask for base in (
    messages.ESTIMATE, messages.MARGIN, messages.LIMIT, messages.GAIN, messages.MUSCLE, messages.JOINT)}
_BASES: dict[type[Any], int] = {layout.type: layout.base for layout in messages.LAYOUTS}


def base_of(kind: type[Any] | str) -> int:
    """The base of a message's type, or of its name."""
    if isinstance(kind, str):
        if kind not in codec.BY_NAME:
            raise unknown("message", kind, codec.BY_NAME)
        return codec.BY_NAME[kind].base
    return _BASES[kind]


class Telemetry:
    """Keeps frames as they came, and decodes them on request."""

    def __init__(self, node: int) -> None:
        self.node = node
        self._newest: dict[int, tuple[float, bytes]] = {}
        self._rounds: dict[int, dict[int, tuple[float, bytes]]] = {base: {} for base in _ROUNDS}
        self._listeners: tuple[Listener, ...] = ()

    def take(self, base: int, time_s: float, data: bytes) -> None:
        """Called from the thread that reads the bus."""
        self._newest[base] = (time_s, data)
        if data and base in self._rounds:
            self._rounds[base][data[0] & _ROUNDS[base]] = (time_s, data)
        for listen in self._listeners:
            listen(base, time_s, data)

    def listen(self, listener: Listener) -> None:
        self._listeners = (*self._listeners, listener)

    def forget(self, listener: Listener) -> None:
        self._listeners = tuple(one for one in self._listeners if one != listener)

    def newest(self, kind: type[M]) -> M | None:
        """The newest message of a kind; None: none has come yet."""
        base = base_of(kind)
        if (kept := self._newest.get(base)) is None:
            return None
        message: M | None = codec.decode(base, kept[1], kept[0])
        return message

    def of(self, kind: type[M]) -> M:
        if (message := self.newest(kind)) is None:
            raise NoAnswerError(f"node {self.node} has sent no {kind.__name__} yet")
        return message

    def _round(self, kind: type[M]) -> list[M]:
        base = base_of(kind)
        decoded = (codec.decode(base, data, time_s) for time_s, data in list(self._rounds[base].values()))
        return [message for message in decoded if message is not None]

    @property
    def status(self) -> messages.Status:
        return self.of(messages.Status)

    @property
    def measurement(self) -> messages.Measurement:
        return self.of(messages.Measurement)

    @property
    def tracking(self) -> messages.Tracking:
        return self.of(messages.Tracking)

    @property
    def power(self) -> messages.Power:
        return self.of(messages.Power)

    @property
    def heater(self) -> messages.Heater:
        return self.of(messages.Heater)

    @property
    def temperature(self) -> messages.Temperature:
        return self.of(messages.Temperature)

    @property
    def timing(self) -> messages.Timing:
        return self.of(messages.Timing)

    @property
    def joint(self) -> messages.Joint:
        """From the node of a joint, its agonist's: the newest frame, with the newest values of the other parts."""
        joint = self.of(messages.Joint)
        parts = {signal.name: getattr(message, signal.name) for message in self._round(messages.Joint)
                 for signal in codec.LAYOUTS[messages.JOINT].signals if signal.selected_by == message.part}
        return joint._replace(**parts)

    @property
    def estimates(self) -> dict[names.Parameter, float]:
        """What the board has learned, by the DBC's names; NaN: not known."""
        values = {}
        for message in self._round(messages.Estimate):
            layout = codec.LAYOUTS[messages.ESTIMATE]
            place = next(i for i, signal in enumerate(layout.signals, 1) if signal.selected_by == message.parameter)
            values[message.parameter] = float(message[place])
        return dict(sorted(values.items()))

    @property
    def gains(self) -> dict[names.Gain, float]:
        """The gains of the active controller."""
        gains = {message.gain: message.value for message in self._round(messages.Gain)}
        return {gain: value for gain, value in sorted(gains.items()) if gain != names.Gain.none}

    @property
    def margins(self) -> dict[names.Fault, messages.Margin]:
        """How near each detector is to tripping."""
        margins = {message.fault: message for message in self._round(messages.Margin)}
        return {fault: margin for fault, margin in sorted(margins.items()) if fault != names.Fault.none}

    @property
    def limits(self) -> dict[names.Fault, float]:
        limits = {message.fault: message.limit for message in self._round(messages.Limit)}
        return {fault: limit for fault, limit in sorted(limits.items()) if fault != names.Fault.none}
