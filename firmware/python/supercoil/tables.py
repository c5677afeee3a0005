"""Frames as a pandas table, with units."""

from collections.abc import Sequence

import pandas

from supercoil import codec
from supercoil.arrays import decode_all
from supercoil.layout import Signal


def _named(signal: Signal, values: pandas.Series) -> pandas.Series:
    """Replaces numbers by their names."""
    if signal.type in (float, int, bool):
        return values
    names = {number: str(signal.type(number)) for number in values.unique()}
    return values.map(names).astype("category")


def table_of(frames: Sequence[tuple[float, int, bytes]]) -> pandas.DataFrame:
    """frames: time, base, data, in order. A row for each time, a column Message.signal for each signal; NaN: the
    message does not carry it at that time. attrs["units"]: of each column."""
    parts, units = [], {}
    for base in sorted({base for _, base, _ in frames if base in codec.LAYOUTS}):
        layout = codec.LAYOUTS[base]
        arrays = decode_all(base, [(time_s, data) for time_s, of, data in frames if of == base])
        columns = {}
        for signal in layout.signals:
            name = f"{layout.name}.{signal.name}"
            columns[name] = _named(signal, pandas.Series(arrays[signal.name], arrays["time_s"]))
            units[name] = signal.unit
        part = pandas.DataFrame(columns)
        parts.append(part[~part.index.duplicated(keep="last")])
    table = pandas.concat(parts, axis=1).sort_index() if parts else pandas.DataFrame()
    table.index.name = "time_s"
    table.attrs["units"] = units
    return table
