"""Converts frames to messages and back, by the table generated from the DBC."""

import math
import struct
from collections.abc import Callable, Mapping
from typing import Any

from supercoil.generated import messages
from supercoil.layout import Layout, Raw, Signal

BASE_MASK = 0x7C0
NODE_MASK = 0x03F
# compare has one opcode for volts, amperes and kelvins: kelvins are sent with this added.
RISES_FROM = 1000.0
# Taking over prepared values is sent as opcode controller, with this added to the controller's place.
TUNES_FROM = 1000.0
# Places of what is tuned: controllers count from 0, estimators from here.
FIRST_ESTIMATOR = 8
# Values of store.
FORGET, STORE, STORE_TUNING, FORGET_TUNING = 0.0, 1.0, 2.0, 3.0

LAYOUTS: Mapping[int, Layout] = {layout.base: layout for layout in messages.LAYOUTS}
BY_NAME: Mapping[str, Layout] = {layout.name: layout for layout in messages.LAYOUTS}

_NAN = math.nan
_Read = Callable[[int], Any]


def _reader(signal: Signal) -> _Read:
    """A function that gets the signal's value out of a frame that was read as one number."""
    start, mask, steps, absent = signal.start, signal.mask, signal.steps, signal.not_available
    kind = signal.type
    if signal.raw is Raw.floating:
        return lambda frame: struct.unpack("<f", (frame >> start & mask).to_bytes(4, "little"))[0]
    if kind is not float:
        return lambda frame: kind(frame >> start & mask)
    half = 1 << signal.length - 1 if signal.raw is Raw.signed else 0

    def scaled(frame: int) -> float:
        raw = ((frame >> start & mask) ^ half) - half
        return _NAN if raw == absent else raw / steps

    return scaled


def _decoder(layout: Layout) -> Callable[[float, int], Any]:
    readers = [(_reader(signal), signal.selected_by) for signal in layout.signals]
    make = layout.type
    if all(selected_by is None for _, selected_by in readers):
        plain = [read for read, _ in readers]
        return lambda time_s, frame: make(time_s, *[read(frame) for read in plain])
    selector = readers[0][0]

    def multiplexed(time_s: float, frame: int) -> Any:
        chosen = selector(frame)
        return make(time_s, *[read(frame) if by is None or by == chosen else _NAN for read, by in readers])

    return multiplexed


_DECODERS = {base: _decoder(layout) for base, layout in LAYOUTS.items()}


def decode(base: int, data: bytes, time_s: float = _NAN) -> Any:
    """A message of generated.messages; None: not of this protocol, or of another length."""
    layout = LAYOUTS.get(base)
    if layout is None or len(data) != layout.length:
        return None
    return _DECODERS[base](time_s, int.from_bytes(data, "little"))


def _raw(signal: Signal, value: float) -> int:
    if signal.raw is Raw.floating:
        try:
            return int.from_bytes(struct.pack("<f", value), "little")
        except OverflowError:
            return int.from_bytes(struct.pack("<f", math.copysign(math.inf, value)), "little")
    if math.isnan(value):
        if signal.not_available is None:
            raise ValueError(f"{signal.name}: NaN")
        return signal.not_available & signal.mask
    signed = signal.raw is Raw.signed
    min_raw = -(1 << signal.length - 1) if signed else 0
    max_raw = min_raw + signal.mask
    if signal.not_available == min_raw:
        min_raw += 1
    elif signal.not_available == max_raw:
        max_raw -= 1
    return round(min(max(value * signal.steps, min_raw), max_raw)) & signal.mask


def encode(layout: Layout, values: Mapping[str, float]) -> bytes:
    """A value beyond its signal's range is sent as the nearest end of the range. Signals that are not named are 0."""
    frame = 0
    for signal in layout.signals:
        if signal.name in values:
            frame |= _raw(signal, values[signal.name]) << signal.start
    return frame.to_bytes(layout.length, "little")
