#!/usr/bin/env python3
"""A joint on the emulated board, the example with an AS5600: both muscles are found, it holds, follows, is pulled
harder, and goes cold when a wire of the antagonist's heater is cut.

Prints what was measured; exits with 1 if any of it is wrong, 2 if the board did not do its part.

    tests/hil/joint_test.py [--architecture amd64]
"""

import argparse
import math
import re
import shutil

import rig
import witness
from firmware_test import MARK_MS, STEP_MS, TICK_MS, states
from table import Table

EXAMPLE = rig.ROOT / "firmware" / "io" / "config" / "examples" / "joint-as5600-ads1115.toml"
M_PER_DEG = 0.015 * math.pi / 180.0  # of the example's lever, which is the plant's default too
SETTLED_S = 8.0  # before a mark
# The current, low-passed with 10 ms, has to fall below a quarter, then 20 ms pass; the rest is margin for ticks of 10 ms.
CUT_MS = 100.0


def angles_deg(looks, begin_s, end_s):
    """The joint's true angle."""
    return [look.channels[0].position_m / M_PER_DEG for look in looks if begin_s <= look.time_s <= end_s]


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values)) if values else None


def holds(table, looks, marks, ended):
    for mark, degrees in (("up", 10.0), ("down", -15.0), ("held", 10.0)):
        found = angles_deg(looks, marks[mark] - SETTLED_S, marks[mark])
        table.row(f"holds {degrees:g} deg: true angle less that, rms", rms([angle - degrees for angle in found]), 0, 0.05, "deg")
    found = angles_deg(looks, marks["held"], marks["pulled"])
    table.row("both pull twice as much: moved from 10 deg by at most", max(abs(angle - 10.0) for angle in found), 0, 0.1, "deg")
    before, after = (witness.at(looks, marks[name] - 0.1).channels for name in ("held", "pulled"))
    table.row("    the command to pull ended with", ended["pulled"], 0, 0, "")
    table.row("    power of both, over that before", sum(c.power_W for c in after) / sum(c.power_W for c in before), 1.8, 2.2, "")


def follows(table, console):
    followed = [(model - y) / M_PER_DEG for state, mode, _, _, model, y in states(console) if (state, mode) == ("active", "position")]
    settled = followed[len(followed) // 2:]
    table.row("states seen while it follows a sine", len(settled), 20, 1e6, "")
    table.row("sine of 20 deg at 0.1 Hz: reference model less position, rms", rms(settled), 0, 0.1, "deg")


def cut(table, run, looks, marks):
    before = witness.at(looks, marks["cut"] - 0.05).channels
    for number, channel in enumerate(before, 1):
        table.row(f"a wire of channel 2 is cut: power of channel {number} before", channel.power_W, 0.2, 4.5, "W")
    off = witness.first(looks, marks["cut"], lambda look: all(c.power_W == 0 and not c.enable for c in look.channels))
    table.row("    both off, by their enables, after", off and (off.time_s - marks["cut"]) * 1e3, 0,
              CUT_MS + 2 * TICK_MS + MARK_MS + STEP_MS, "ms")
    states_after = re.findall(r"^after (\d) (\w+) \w+ (\w+)", run.console.replace("\r", ""), re.M)
    for number in ("1", "2"):
        table.row(f"    channel {number}: in fault, of heater_open", (number, "fault", "heater_open") in states_after, 1, 1, "")
    table.row("    heated again before its reset, looks",
              sum(any(c.power_W > 0 for c in look.channels) for look in looks if off and off.time_s < look.time_s < marks["cut"] + 3),
              0, 0, "")


def judge(table, run):
    marks, _ = witness.marks_and_reads(run.console)
    console = run.console.replace("\r", "")
    ended = {what: int(status) for what, status in
             re.findall(r"^(identified|tracked|pulled|its command ended with|firmware ended with) (\d+)$", console, re.M)}
    looks = witness.looks(run.witness)
    table.row("the script ended with", run.status, 0, 0, "")
    table.row("identify of both ended with", ended["identified"], 0, 0, "")
    table.row("    after", marks["identified"] - marks["armed"], 60, 400, "s")
    holds(table, looks, marks, ended)
    follows(table, run.console)
    table.row("the command to follow ended with", ended["tracked"], 0, 0, "")
    cut(table, run, looks, marks)
    table.row("    the command that held it fails", ended["its command ended with"], 1, 1, "")
    table.row("    reset of one resets both", console.count("reset both"), 1, 1, "")
    hottest_K = max(c.rise_K for look in looks for c in look.channels)
    table.row("hottest of both, above the air", hottest_K, 10, 100, "K")
    table.row("overruns: heartbeat's edges left out while it followed", overruns(looks, marks), 0, 0, "")
    table.row("SIGTERM ended it with", ended["firmware ended with"], 0, 0, "")


def overruns(looks, marks):
    begin, end = witness.at(looks, marks["identified"]), witness.at(looks, marks["cut"])
    return round((end.edge_s - begin.edge_s) * 1e3 / TICK_MS) - (end.edges - begin.edges)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    rig.add_architecture(parser)
    settings = rig.Settings(parser.parse_args().architecture, "joint_test", watchdog=True, can=1, time_out_s=2400.0)
    settings.share.mkdir(parents=True, exist_ok=True)
    shutil.copy(EXAMPLE, settings.share / "example.toml")
    table = Table()
    table.judge("joint", judge, rig.run(rig.HERE / "scripts" / "joint", (), settings))
    table.end()


if __name__ == "__main__":
    main()
