"""Reads what the plant's witness (plant/witness.hpp has its columns) and a script of the board reported.

Times are seconds of the board's CLOCK_MONOTONIC.
"""

import dataclasses
import re


@dataclasses.dataclass
class Channel:
    enable: int
    duty: float
    power_W: float
    position_m: float
    rise_K: float
    current_A: float


@dataclasses.dataclass
class Look:
    time_s: float
    edges: int
    edge_s: float  # when the last edge was seen; 0: none yet
    stop: int
    light: int
    closed: int
    channels: list


@dataclasses.dataclass
class Steps:
    time_s: float
    steps: int
    missed: int
    mean_us: int
    max_us: int
    late_us: int


def looks(lines):
    found = []
    for line in lines:
        words = line.split()
        # The last line of a board that died may be cut.
        if words[:1] != ["W"] or len(words) < 13 or (len(words) - 7) % 6:
            continue
        n = [int(word) for word in words[1:]]
        channels = [Channel(n[i], n[i + 1] / 4096, n[i + 2] / 1e3, n[i + 3] / 1e6, n[i + 4] / 1e3, n[i + 5] / 1e3)
                    for i in range(6, len(n), 6)]
        found.append(Look(n[0] / 1e6, n[1], n[2] / 1e6, n[3], n[4], n[5], channels))
    return found


def steps(lines):
    rows = [[int(word) for word in line.split()[1:]] for line in lines if line.startswith("S ")]
    return [Steps(row[0] / 1e6, *row[1:]) for row in rows if len(row) == 6]


def at(found, time_s):
    """The newest look that is not after time_s."""
    return max((look for look in found if look.time_s <= time_s), key=lambda look: look.time_s, default=found[0])


def first(found, from_s, holds):
    """The first look from a time on for which something holds, or None."""
    return next((look for look in found if look.time_s >= from_s and holds(look)), None)


def marks_and_reads(console):
    """Marks (name: seconds; the latest of each) and readings (name: counts, None for no value) of a script."""
    marks = {name: float(time) for name, time in re.findall(r"^mark (\w+) ([\d.]+)\r?$", console, re.M)}
    reads = {name: None if counts == "none" else int(counts)
             for name, counts in re.findall(r"^read (\w+) (none|-?\d+)\r?$", console, re.M)}
    return marks, reads
