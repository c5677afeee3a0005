"""Decodes many frames of one message at once into numpy arrays."""

from collections.abc import Sequence
from typing import Any

import numpy

from supercoil import codec
from supercoil.layout import Raw, Signal

Array = numpy.ndarray[Any, Any]


def _column(signal: Signal, frames: Array, selectors: Array) -> Array:
    raw = frames >> numpy.uint64(signal.start) & numpy.uint64(signal.mask)
    if signal.raw is Raw.floating:
        with numpy.errstate(invalid="ignore"):  # NaN is a valid value here
            values = raw.astype("<u4").view("<f4").astype(float)
    elif signal.type is not float:
        return raw.astype(bool if signal.type is bool else int)
    else:
        whole = raw.astype(numpy.int64)
        if signal.raw is Raw.signed:
            half = 1 << signal.length - 1
            whole = (whole ^ half) - half
        values = whole / signal.steps
        if signal.not_available is not None:
            values = numpy.where(whole == signal.not_available, numpy.nan, values)
    if signal.selected_by is not None:
        values = numpy.where(selectors == signal.selected_by, values, numpy.nan)
    return values


def decode_all(base: int, frames: Sequence[tuple[float, bytes]]) -> dict[str, Array]:
    """time_s and every signal; frames of another length are left out. Names are given as numbers."""
    layout = codec.LAYOUTS[base]
    whole = [(time_s, data) for time_s, data in frames if len(data) == layout.length]
    packed = numpy.frombuffer(b"".join(data.ljust(8, b"\0") for _, data in whole), "<u8")
    selectors = packed & numpy.uint64(layout.signals[0].mask)
    columns: dict[str, Array] = {"time_s": numpy.array([time_s for time_s, _ in whole], float)}
    columns.update({signal.name: _column(signal, packed, selectors) for signal in layout.signals})
    return columns
