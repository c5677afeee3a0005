"""Loads files of boards and simulations as pandas tables. attrs["units"] has each column's unit."""

import re
from collections import deque
from pathlib import Path
from typing import Any

import numpy
import pandas
from numpy.typing import NDArray

from supercoil import codec
from supercoil.flight import MAGIC, load_flight
from supercoil.tables import table_of
from supercoil.units import unit_of

_CANDUMP = re.compile(rb"\((\d+\.\d+)\)\s+\S+\s+([0-9A-Fa-f]{3})#((?:[0-9A-Fa-f]{2}){0,8})(?:\s+[RT])?")
# When a simulated run begins in its can.log, and how long a run may be (can_client/candump.hpp).
_SIMULATION_EPOCH_S = 1_000_000_000
_MAX_RUN_S = 365 * 86400
_NPY = b"\x93NUMPY"
# From 3.1 on pandas reads every number exactly, and warns of this option; before, it was off by a bit.
_READS_EXACTLY = tuple(map(int, pandas.__version__.split(".")[:2])) >= (3, 1)
_EXACT: dict[str, Any] = {} if _READS_EXACTLY else {"float_precision": "round_trip"}


def load(path: str | Path, *, node: int | None = None) -> pandas.DataFrame:
    """Loads can.log (as candump -L writes it), a flight recording, trace.csv or trace.npy, by content, not by name.

    The index is time_s, as in the file; for a recording, relative to its fault. can.log: columns are Message.signal;
    node: which one; optional if the log has only one. attrs["damaged_lines"]: lines left out.
    """
    file = Path(path)
    with file.open("rb") as opened:
        start = opened.read(len(MAGIC))
    if not start:
        raise ValueError(f"{file}: is empty")
    if start == MAGIC:
        return load_flight(file)
    if start.startswith(_NPY):
        return _load_npy(file)
    if start.startswith(b"time_s"):
        return _load_csv(file)
    lines = [_CANDUMP.fullmatch(line.strip()) for line in file.read_bytes().splitlines() if line.strip()]
    # The first line may be damaged as any other.
    return _load_candump(file, lines, node) if start.startswith(b"(") or any(lines) else _load_csv(file)


def _load_candump(file: Path, lines: list[re.Match[bytes] | None], node: int | None) -> pandas.DataFrame:
    frames: dict[int, list[tuple[float, int, bytes]]] = {}
    for found in lines:
        if found is None:
            continue
        identifier = int(found[2], 16)
        base = identifier & codec.BASE_MASK
        if base in codec.LAYOUTS:
            frames.setdefault(identifier & codec.NODE_MASK, []).append(
                (_time_of_run_s(found[1].decode()), base, bytes.fromhex(found[3].decode())))
    if node is None and len(frames) > 1:
        raise ValueError(f"{file}: has nodes {', '.join(map(str, sorted(frames)))}: say which one, node=...")
    if node is not None and node not in frames:
        raise ValueError(f"{file}: has no node {node}; there are {', '.join(map(str, sorted(frames))) or 'none'}")
    chosen = next(iter(frames), 0) if node is None else node
    table = table_of(frames.get(chosen, []))
    table.attrs["node"] = chosen
    table.attrs["damaged_lines"] = lines.count(None)
    return table


def _time_of_run_s(text: str) -> float:
    """Time since a simulated run began; for another log, or one of an older simulator, its own time."""
    whole, _, fraction = text.partition(".")
    in_run = int(whole) - _SIMULATION_EPOCH_S
    return float(f"{in_run if 0 <= in_run < _MAX_RUN_S else int(whole)}.{fraction}")


def _load_csv(file: Path) -> pandas.DataFrame:
    try:
        table = pandas.read_csv(file, **_EXACT)
    except (pandas.errors.EmptyDataError, pandas.errors.ParserError, UnicodeDecodeError) as error:
        raise ValueError(f"{file}: is not a table: {str(error).strip()}") from error
    if not len(table.columns) or table.columns[0] != "time_s":
        raise ValueError(f"{file}: is not a can.log, a flight recording or a CSV whose first column is time_s")
    _check_last_line(file, len(table.columns))
    return _with_units(table)


def _check_last_line(file: Path, columns: int) -> None:
    """pandas would take the fields that a truncated file lacks for missing values."""
    with file.open("rb") as opened:
        number, last = deque(enumerate(opened, 1), maxlen=1)[0]
    fields = last.count(b",") + 1
    if last.strip() and fields < columns:
        raise ValueError(f"{file}:{number}: has {fields} fields; there are {columns} columns: the file is cut off")


def _load_npy(file: Path) -> pandas.DataFrame:
    try:
        rows = numpy.load(file, allow_pickle=False)
    except (ValueError, OSError, EOFError) as error:
        raise ValueError(f"{file}: {error}") from error
    if not rows.dtype.names or rows.dtype.names[0] != "time_s":
        raise ValueError(f"{file}: is not a trace: its records do not begin with time_s")
    return _with_units(pandas.DataFrame({name: _decoded(rows[name]) for name in rows.dtype.names}))


def _decoded(column: NDArray[Any]) -> NDArray[Any]:
    """Words rarely change from row to row: each run of equal words is decoded once."""
    if column.dtype.kind != "S" or len(column) == 0:
        return column
    begins = numpy.flatnonzero(numpy.concatenate(([True], column[1:] != column[:-1])))
    words = numpy.array([word.decode("ascii") for word in column[begins]], dtype=object)
    return numpy.repeat(words, numpy.diff(numpy.append(begins, len(column))))


def _with_units(table: pandas.DataFrame) -> pandas.DataFrame:
    table = table.set_index("time_s")
    table.attrs["units"] = {column: unit_of(column) for column in table.columns}
    return table
