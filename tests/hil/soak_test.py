#!/usr/bin/env python3
"""The emulated board for hours of its own time: two muscles follow on a board with CAN, each cycle ends with a fault.
Time, memory, descriptors, files and tracking must be the same at the end as in the beginning.

    tests/hil/soak_test.py [--seconds 3600] [--architecture amd64]
"""

import argparse
import re

import rig
import witness
from firmware_test import TICK_MS
from table import Table

COLUMNS = ("cycle", "resident_kB", "descriptors", "threads", "files", "files_kB")
SINES = ((0.010, 0.003, 10.0), (0.008, 0.003, 12.0))  # of each muscle: middle and amplitude in m, period in s
FIRST = 2  # the cycle to compare with: the first one still fills what is kept
MIN_SECONDS = 750  # three cycles


def cycles(console):
    return [dict(zip(COLUMNS, map(float, words.split()))) for words in re.findall(r"^cycle ([\d. ]+)\r?$", console, re.M)]


def swing_m(looks, channel, period_s, end_s):
    """Largest minus smallest true position in the cycle's last periods."""
    positions = [look.channels[channel].position_m for look in looks if end_s - 4 * period_s <= look.time_s <= end_s - period_s]
    return max(positions) - min(positions)


def judge(table, run, seconds):
    marks, _ = witness.marks_and_reads(run.console)
    console = run.console.replace("\r", "")
    looks = witness.looks(run.witness)
    sizes = cycles(run.console)
    first, last = sizes[FIRST - 1], sizes[-1]
    table.row("the script ended with", run.status, 0, 0, "")
    table.row("cycles", len(sizes), FIRST + 1, 1e6, "")
    table.row("of the board's time", marks["ended"] - marks["begin"], seconds, seconds + 300, "s")
    statuses = re.findall(r"^ended (?:identify|sine) \d: (\d+)$", console, re.M)
    table.row("commands that ended with 0: two to identify, two of each cycle", statuses.count("0"), 2 + 2 * len(sizes), len(statuses), "")
    faults = re.findall(r"^after (\d) (\w+) \w+ (\w+)", console, re.M)
    table.row("cycles whose injected fault was reported by channel 1 alone",
              sum(pair == (("1", "fault", "sensor_out_of_range"), ("2", "armed", "none")) for pair in zip(faults[::2], faults[1::2])),
              len(sizes), len(sizes), "")
    begin, end = witness.at(looks, marks["begin"]), witness.at(looks, marks["ended"])
    ticks = (end.edge_s - begin.edge_s) * 1e3 / TICK_MS
    table.row("ticks by the clock, less heartbeat's edges", ticks - (end.edges - begin.edges), -0.5, 0.5, "")
    for key, more, unit in (("resident_kB", 200, "kB"), ("descriptors", 0, ""), ("threads", 0, "")):
        table.row(f"{key} at the end, less after cycle {FIRST}", last[key] - first[key], -1e6, more, unit)
    table.row("files kept: at most", max(size["files"] for size in sizes), 1, 20, "")
    table.row("    which take at most", max(size["files_kB"] for size in sizes), 1, 8192, "kB")
    for channel, (_, amplitude_m, period_s) in enumerate(SINES):
        swings = [swing_m(looks, channel, period_s, marks[f"end{number:.0f}"]) for number in (FIRST, last["cycle"])]
        table.row(f"channel {channel + 1}: swing in cycle {FIRST}, over twice the amplitude of its reference", swings[0] / (2 * amplitude_m), 0.6, 1.0, "")
        table.row("    in the last one, over that", swings[1] / swings[0], 0.998, 1.002, "")
    table.row("hottest of both, above the air", max(c.rise_K for look in looks for c in look.channels), 10, 100, "K")
    table.row("SIGTERM ended it with", int(re.search(r"^firmware ended with (\d+)", console, re.M)[1]), 0, 0, "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=int, default=3600, help=f"of the board's time, {MIN_SECONDS} at least (default: 3600)")
    rig.add_architecture(parser)
    args = parser.parse_args()
    if args.seconds < MIN_SECONDS:
        parser.error(f"--seconds {args.seconds}: must be {MIN_SECONDS} at least")
    sines = [" ".join(map(str, sine)) for sine in SINES]
    settings = rig.Settings(args.architecture, "soak_test", watchdog=True, can=2, time_out_s=1200.0 + 2.0 * args.seconds)
    table = Table()
    run = rig.run(rig.HERE / "scripts" / "soak", (args.seconds, *sines), settings)
    table.judge("soak", lambda t, r: judge(t, r, args.seconds), run)
    table.end()


if __name__ == "__main__":
    main()
