"""Recordings of the flight recorder: format 1 (docs/recorder.md)."""

import re
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy
import pandas

from supercoil.generated.names import Fault, Gain, LimitedBy, Mode, Result, State
from supercoil.units import unit_of

MAGIC = b"supercoil flight recording"
_HEADER_BYTES = 512
_FORMAT = 1
_FIRST_LINE = re.compile(rb"supercoil flight recording, format (\d+), CRC-32 ([0-9a-f]{8})\n")
_KEY = re.compile(r'^(\w+) = "?([^"\n]*)"?$', re.M)

_FLOATS = ("reference", "model_m", "position_m", "demanded_W", "applied_W", "duty", "supply_V", "current_A",
           "resistance_Ohm", "resistance_age_s", "coldest_C", "hottest_C", "theta1", "theta2", "theta3", "theta4",
           "error_bound", "progress", "margin_used", "margin_measured", "margin_limit", "gain")
_ROW = numpy.dtype([
    ("time_ns", "<i8"), ("channel", "u1"), ("state", "u1"), ("mode", "u1"), ("fault", "u1"), ("limited_by", "u1"),
    ("controller", "u1"), ("flags", "u1"), ("margin_selector", "u1"), *((name, "<f4") for name in _FLOATS),
    ("gain_selector", "u1"), ("result", "u1"), ("multiplexed_selector", "u1"), ("identify_notes", "u1"),
    ("multiplexed_value", "<f4")])
_FLAGS = {"probing": 1, "trusted": 2, "limited": 4, "proof_off": 8, "oscillated": 16, "slack": 32}
_MULTIPLEXED = ("none", "bias", "theta1_deviation", "theta2_deviation", "theta3_deviation", "theta4_deviation",
                "bias_deviation")
_NAMES: dict[str, Callable[[int], object]] = {
    "state": State, "mode": Mode, "fault": Fault, "limited_by": LimitedBy, "margin_selector": Fault,
    "gain_selector": Gain, "result": Result,
    "multiplexed_selector": lambda number: _MULTIPLEXED[number] if number < len(_MULTIPLEXED) else number}


def _rows(file: Path) -> tuple[dict[str, str], numpy.ndarray[Any, Any]]:
    content = file.read_bytes()
    header, rows = content[:_HEADER_BYTES], content[_HEADER_BYTES:]
    if len(header) < _HEADER_BYTES:
        raise ValueError(f"{file}: is cut off after {len(header)} of the {_HEADER_BYTES} bytes of its header")
    first = _FIRST_LINE.match(header)
    if first is None or int(first[1]) != _FORMAT:
        raise ValueError(f"{file}: is not a flight recording of format {_FORMAT}")
    if zlib.crc32(header[first.end():]) != int(first[2], 16):
        raise ValueError(f"{file}: its header is damaged; supercoil log --damaged reads what it can")
    keys = dict(_KEY.findall(header.decode()))
    whole = len(rows) // _ROW.itemsize
    if whole < int(keys["rows"]):
        raise ValueError(f"{file}: is cut off after {whole} of {keys['rows']} rows; supercoil log --damaged reads them")
    if zlib.crc32(rows) != int(keys["rows_CRC32"], 16) or len(rows) != int(keys["rows"]) * _ROW.itemsize:
        raise ValueError(f"{file}: its rows are damaged; supercoil log --damaged reads what it can")
    return keys, numpy.frombuffer(rows, _ROW)


def load_flight(file: Path) -> pandas.DataFrame:
    """One row for each tick of each channel, channels from 1. attrs also has the fault and its channel."""
    keys, rows = _rows(file)
    time_s = (rows["time_ns"] - int(keys["fault_time_ns"])) / 1e9
    columns: dict[str, Any] = {"channel": rows["channel"].astype(int) + 1}
    for name in rows.dtype.names or ():
        if name in ("time_ns", "channel"):
            continue
        if name == "flags":
            columns.update({flag: rows[name] & bit != 0 for flag, bit in _FLAGS.items()})
        elif name in _NAMES:
            words = {number: str(_NAMES[name](int(number))) for number in numpy.unique(rows[name])}
            columns[name] = pandas.Categorical([words[number] for number in rows[name]])
        else:
            columns[name] = rows[name]
    table = pandas.DataFrame(columns, index=pandas.Index(time_s, name="time_s"))
    table.attrs["units"] = {column: unit_of(column) for column in table.columns}
    table.attrs["fault"] = keys["fault_name"]
    table.attrs["fault_channel"] = int(keys["fault_channel"])
    return table
