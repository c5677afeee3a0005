#!/usr/bin/env python3
"""The emulated board itself: its physics responds to the kernel's real drivers, and they respond to it.

Operates PWM, lines, converters and watchdog of the board by hand (scripts/), and compares what the drivers read with what
the plant's witness saw. Prints what was measured; exits with 1 if any of it is wrong, 2 if the board did not work.

    tests/hil/drivers_test.py [--architecture amd64]
"""

import argparse

import can_rows
import rig
import witness
from table import Table

M_PER_COUNT = 0.040 / 3.3 * 125e-6
A_PER_COUNT = 125e-6
V_PER_COUNT = 4.3 * 125e-6
DECAY_MS = 20.0
STEP_MS = 1.0
SLOW_MS = 10.0  # how often the plant reads the stop circuit


def drivers(table, run):
    marks, reads = witness.marks_and_reads(run.console)
    looks = witness.looks(run.witness)

    def at(name, later_s=0.05):
        return witness.at(looks, marks[name] + later_s)

    for percent in (100, 50, 25):
        table.row(f"PWM set to {percent} %: the chip's registers say", at(f"duty_{percent}").channels[0].duty,
                  percent / 100 - 0.0005, percent / 100 + 0.0005, "")
    table.row("PWM set to 0 %", at("duty_0").channels[0].duty, 0, 0, "")
    table.row("without heartbeat and enable: power", at("duty_25").channels[0].power_W, 0, 0, "W")
    table.row("                              position read", reads["rest_position"] * M_PER_COUNT * 1e3, 0, 0.05, "mm")
    table.row("                              current read", reads["rest_current"] * A_PER_COUNT * 1e3, 0, 3, "mA")
    table.row("supply read", reads["supply"] * V_PER_COUNT, 11.98, 12.02, "V")

    hot = at("hot", 0.0)
    table.row("with both: supply's switch closed", hot.closed, 1, 1, "")
    table.row("           power, 0.25 x (12 V)^2 / 10 Ohm", hot.channels[0].power_W, 3.59, 3.61, "W")
    table.row("           current read", reads["hot_current"] * A_PER_COUNT * 1e3, 295, 305, "mA")
    # The muscle moves by 5 mm/s, and reading takes time: the value must lie between the truth before and after.
    table.row("           position read", reads["hot_position"] * M_PER_COUNT * 1e3,
              hot.channels[0].position_m * 1e3 - 0.05, at("hang", 0.0).channels[0].position_m * 1e3 + 0.05, "mm")
    table.row("           it has moved by", hot.channels[0].position_m * 1e3, 5, 20, "mm")
    table.row("           heartbeat's edges in a second", witness.at(looks, marks["hot"]).edges -
              witness.at(looks, marks["hot"] - 1).edges, 985, 1015, "")
    table.row("the other channel: position read", reads["other_position"] * M_PER_COUNT * 1e3, 0, 0.05, "mm")

    for name, label, extra_ms in (("hang", "firmware stopped, enable stays high", 0),
                                  ("stop", "stop pressed", SLOW_MS)):
        opened = witness.first(looks, marks[name], lambda look: not look.closed)
        after_ms = None if opened is None else (opened.time_s - opened.edge_s) * 1e3
        table.row(f"{label}: supply opens after the last edge", after_ms, DECAY_MS - STEP_MS,
                  DECAY_MS + 2 * STEP_MS + extra_ms, "ms")
        table.row("           its enable then", opened and opened.channels[0].enable, 1, 1, "")
        table.row("           its power then", opened and opened.channels[0].power_W, 0, 0, "W")
    killed = witness.first(looks, marks["kill"] - 0.02, lambda look: not look.channels[0].enable)
    table.row("firmware killed: enable falls by its pull", killed and (killed.time_s - marks["kill"]) * 1e3, -20, 20, "ms")
    table.row("           its power then", at("kill").channels[0].power_W, 0, 0, "W")

    table.row("wire open: current read", reads["open_current"] * A_PER_COUNT * 1e3, 0, 3, "mA")
    table.row("position's wire off: read", reads["loose_position"], -7000, -6000, "")
    table.row("converter without driver: a value", reads["gone_current"] is not None, 0, 0, "")
    table.row("with its driver again: read", reads["back_current"] * A_PER_COUNT * 1e3, 295, 305, "mA")
    reports = [line for line in run.witness if line.startswith("T ")]
    table.row("injected faults that the plant reports", len(reports), 5, 5, "")
    table.row("           of them refused", sum("refused" in line for line in reports), 1, 1, "")

    steps = witness.steps(run.witness)[1:]
    table.row("the plant's step: mean", sum(s.mean_us for s in steps) / len(steps), 1, 250, "us")
    table.row("           longest", max(s.max_us for s in steps), 1, 900, "us")
    table.row("           latest wake-up", max(s.late_us for s in steps), 0, 500, "us")
    table.row("           left out", sum(s.missed for s in steps), 0, 0, "")


def panic(table, run):
    marks, _ = witness.marks_and_reads(run.console)
    last = witness.looks(run.witness)[-1]
    table.row("kernel died: the run ends as", run.status, rig.DIED, rig.DIED, "")
    table.row("           the witness reports until", (last.time_s - marks["panic"]) * 1e3, -20, 20, "ms")
    table.row("           and saw the heat on: supply closed", last.closed, 1, 1, "")


def watchdog(table, run):
    marks, _ = witness.marks_and_reads(run.console)
    table.row("watchdog not fed: the run ends as", run.status, rig.DIED, rig.DIED, "")
    table.row("           off after the last feeding", marks["hungry"] - marks["fed"], 2, 6, "s")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    rig.add_architecture(parser)
    architecture = parser.parse_args().architecture
    table = Table()
    for part, options in ((drivers, {}), (can_rows.can, {"can": 2}), (panic, {}), (watchdog, {"watchdog": True})):
        name = part.__name__
        settings = rig.Settings(architecture, f"{name}_test", **options)
        run = rig.run(rig.HERE / "scripts" / name, settings=settings)
        table.judge(name, part, run)
    table.end()


if __name__ == "__main__":
    main()
