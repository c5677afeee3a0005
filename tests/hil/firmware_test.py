#!/usr/bin/env python3
"""The firmware on the emulated board: it tracks, and whatever happens to it, the heat goes off in time.

supercoild is the ordinary program with an ordinary configuration (board.toml, 100 Hz), over the kernel's real drivers.
The plant's witness, outside of the board, saw when power went off and by which means. Prints what was
measured; exits with 1 if any of it is wrong, 2 if the board did not do its part.

    tests/hil/firmware_test.py [--track SECONDS] [--only track|captured|calls|air|deaths] [--architecture amd64]
"""

import argparse
import re

import rig
import witness
from table import Table

DECAY_MS = 150.0
TICK_MS = 10.0
MARK_MS = 10.0  # the board's uptime has a resolution of 10 ms
STEP_MS = 2.0  # of the plant

# What happens, within which time power must be off, and by which means. The time begins when the board reported that it
# does it, or, where the charge pump cuts, at the heartbeat's last edge.
DEATHS = (
    ("stop", "stop pressed", 2 * TICK_MS + MARK_MS, "enable"),
    # Its last value stays good for max_age (three ticks here).
    ("sensor", "position's converter vanishes", 6 * TICK_MS + MARK_MS, "enable"),
    ("busy", "another program takes the processor", DECAY_MS, "supply"),
    ("stopped", "SIGSTOP", DECAY_MS, "supply"),
    ("term", "SIGTERM", 5 * TICK_MS + 20 + MARK_MS, "enable"),
    # Lines fall by their pulls once the kernel has torn the process down; the pump would cut soon after.
    ("kill", "SIGKILL", DECAY_MS, "enable"),
)


def states(console):
    """Of channel 1: (state, mode, fault, reference_m, model_m, position_m)."""
    return [(m[1], m[2], m[3], float(m[4]), float(m[5]), float(m[6]))
            for m in re.finditer(r"^state 1 (\w+) (\w+) (\w+) (\S+) (\S+) (\S+)", console, re.M)]


def track(table, run, seconds):
    marks, _ = witness.marks_and_reads(run.console)
    table.row("the script ended with", run.status, 0, 0, "")
    table.row("armed after", marks["armed"] - marks["disarmed"], 0, 10, "s")
    table.row("identified after", marks["identified"] - marks["armed"], 50, 90, "s")
    table.row("tracked for", marks["tracked"] - marks["identified"], seconds, seconds + 2, "s")
    followed = [(model, y) for state, mode, _, _, model, y in states(run.console) if (state, mode) == ("active", "position")]
    settled = followed[len(followed) // 4:]
    table.row("states seen while it tracked", len(settled), seconds / 2, 1e6, "")
    error_m = (sum((y - model) ** 2 for model, y in settled) / len(settled)) ** 0.5
    table.row("tracking error against its model, rms, PI, sine of 10 s", error_m * 1e6, 0, 500, "um")
    table.row("faults", sum("is fault" in line for line in run.console.splitlines()), 0, 0, "")
    # Every tick ends with an edge: an overrun leaves one out.
    looks = witness.looks(run.witness)
    begin, end = witness.at(looks, marks["armed"]), witness.at(looks, marks["tracked"])
    table.row("ticks since it was armed, by the heartbeat's edges", end.edges - begin.edges, 100 * seconds, 1e6, "")
    table.row("    overruns: left out", round((end.edge_s - begin.edge_s) * 1e3 / TICK_MS) - (end.edges - begin.edges),
              0, 0, "")
    table.row("stored what it learned", "learned-1.toml" in run.console, 1, 1, "")
    table.row("SIGTERM ended it with", int(re.search(r"firmware ended with (\d+)", run.console)[1]), 0, 0, "")
    steps = witness.steps(run.witness)[1:]
    table.row("the plant's latest wake-up", max(s.late_us for s in steps), 0, 1000, "us")


# Conversions at the times of the kernel's timer, into its buffers.
CAPTURED_S = 30
CALLS_S = 30


def calls(table, run):
    """What the loop's own thread calls in its ticks, over real drivers: cold, armed, active, in a fault."""
    counted = {name: int(number) for name, number in re.findall(r"^counted (\w+) (\d+)", run.console, re.M)}
    table.row("ticks of the loop, counted", counted["ticks"], 100 * CALLS_S, 100 * CALLS_S, "")
    table.row("    of them heating, in position", counted["active"], 1000, 1e6, "")
    table.row("    of them in a fault: its position's converter is gone", counted["fault"], 50, 1e6, "")
    for what, name in (("malloc", "malloc"), ("new", "new"), ("locks", "locks"), ("exceptions", "exceptions"),
                       ("files, beside the watchdog's feeding", "files"), ("overruns", "overruns")):
        table.row(f"    {what}", counted[name], 0, 0, "")
    table.row("counters that are blind", len(re.findall(r"^counter sees .* NO", run.console, re.M)), 0, 0, "")
    table.row("it ended with", int(re.search(r"^it ended with (\d+)", run.console, re.M)[1]), 0, 0, "")


# The air sensor is right within 2 K; without it the air is that of board.toml.
AIR = (("well", "air of 20 C", 18, 22),
       ("hot", "40 C, above its warmest", 15, 42),
       ("well_again", "20 C again", 18, 22),
       ("gone", "its sensor is gone", 15, 30))


def air(table, run):
    """The coldest and the hottest that a cold muscle may be, as the board reports them."""
    for name, what, coldest_C, hottest_C in AIR:
        bounds = re.search(rf"^bounds {name} (.*)", run.console, re.M)[1].split()
        for which, value_C, right_C in (("coldest", bounds[7], coldest_C), ("hottest", bounds[8], hottest_C)):
            table.row(f"{what}: {which}", float(value_C), right_C - 0.2, right_C + 0.2, "C")
    table.row("SIGTERM ended it with", int(re.search(r"firmware ended with (\d+)", run.console)[1]), 0, 0, "")


def means(look):
    """How the heat was cut, as far as the witness sees."""
    channel = look.channels[0]
    return [name for name, cut in (("enable", not channel.enable), ("duty", channel.duty == 0),
                                   ("supply", not look.closed)) if cut]


def deaths(table, run):
    marks, _ = witness.marks_and_reads(run.console)
    looks = witness.looks(run.witness)
    for mark, what, max_ms, by in DEATHS:
        before = witness.at(looks, marks[mark] - 0.05)
        table.row(f"{what}: power before", before.channels[0].power_W, 1.5, 2.5, "W")
        # Earlier by the mark's own uncertainty.
        off = witness.first(looks, marks[mark] - MARK_MS / 1e3, lambda look: look.channels[0].power_W == 0)
        since_s = off.edge_s if off is not None and by == "supply" else marks[mark]
        after_ms = None if off is None else (off.time_s - since_s) * 1e3
        table.row(f"    off {'after the last edge' if by == 'supply' else 'after'}, by {' and '.join(means(off)) if off else 'nothing'}", after_ms, -MARK_MS,
                  max_ms + STEP_MS, "ms")
        table.row(f"    among them {by}", off is not None and by in means(off), 1, 1, "")
    last = looks[-1]
    table.row("kernel panic: heat was on", last.channels[0].power_W, 1.5, 2.5, "W")
    table.row("    the watchdog put the board off", run.status, rig.DIED, rig.DIED, "")
    table.row("SIGTERM ended it with", int(re.search(r"firmware ended with (\d+)", run.console)[1]), 0, 0, "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--track", metavar="SECONDS", type=int, default=60, help="of the board's time (default: 60)")
    parser.add_argument("--only", choices=("track", "captured", "calls", "air", "deaths"), help="one of the boards")
    rig.add_architecture(parser)
    args = parser.parse_args()
    seconds = args.track
    table = Table()
    for name, script, part, arguments, options in (
            ("track", "track", lambda t, r: track(t, r, seconds), (seconds,), {}),
            ("captured", "track", lambda t, r: track(t, r, CAPTURED_S), (CAPTURED_S, "captured"), {}),
            ("calls", "calls", calls, (100 * CALLS_S,), {}),
            ("air", "air", air, (), {}),
            ("deaths", "deaths", deaths, (), {"kernel_options": "panic=0"})):
        if args.only not in (None, name):
            continue
        settings = rig.Settings(args.architecture, f"{name}_test", watchdog=True, time_out_s=600.0 + 4.0 * seconds, **options)
        run = rig.run(rig.HERE / "scripts" / script, arguments, settings)
        table.judge(name, part, run)
    table.end()


if __name__ == "__main__":
    main()
