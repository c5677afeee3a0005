#!/usr/bin/env python3
"""Two boards on one CAN bus: each with a supercoild of its own, commanded from a third controller, one of them killed.

Prints what was measured; exits with 1 if any of it is wrong, 2 if the boards did not do their part.

    .venv/bin/python tests/hil/two_boards_test.py [--architecture amd64]
"""

import telemetry_test
import two_boards
import witness

PROTECTED_MS = 150.0 + 20.0  # the charge pump's decay, and a step of the plant


def steady_mm(looks, begin_s, end_s):
    positions = [look.channels[0].position_m * 1e3 for look in looks if begin_s <= look.time_s <= end_s]
    return min(positions), max(positions)


def judge(table, run, share):
    marks, _ = witness.marks_and_reads(run.console)
    console = run.console.replace("\r", "")
    ended = two_boards.exit_statuses(console)
    two_boards.judge_begin(table, run, ended)
    frames = list(telemetry_test.decoded(telemetry_test.protocol(), (share / "can.log").read_text()))
    nodes = {node for _, node, message, _ in frames if message.name == "Status"}
    table.row("nodes on the bus: 5, 6 of one board, 9 of the other", nodes == {5, 6, 9}, 1, 1, "")
    first, second = two_boards.looks(run, share)
    low, high = steady_mm(first, marks["held"] - 2, marks["held"])
    table.row("both hold: the first at least at", low, 4.9, 5.1, "mm")
    table.row("    at most", high, 4.9, 5.1, "mm")
    low, high = steady_mm(second, marks["held"] - 2, marks["held"])
    table.row("    the second at least at", low, 7.9, 8.1, "mm")
    table.row("    at most", high, 7.9, 8.1, "mm")
    off = witness.first(second, marks["held"], lambda look: look.channels[0].power_W == 0)
    table.row("the second is killed: its power is off after", (off.time_s - marks["held"]) * 1e3, 0, PROTECTED_MS + 100, "ms")
    table.row("    the command that held it fails", ended["held 9"], 1, 1, "")
    table.row("    and a command to it is not answered", ended["arm dead 9"], 1, 1, "")
    low, high = steady_mm(first, marks["killed"], marks["alone"])
    table.row("    the first goes on, at least at", low, 4.9, 5.1, "mm")
    table.row("    at most", high, 4.9, 5.1, "mm")
    warm = [look for look in second if off.time_s < look.time_s and look.channels[0].power_W > 0]
    table.row("    the second was heated again, looks", len(warm), 0, 0, "")
    table.row("    and is disarmed when it comes back", console.count("seen 9 disarmed"), 2, 2, "")
    table.row("the first was held to the end", ended["held 5"], 0, 0, "")
    faults = [node for _, node, message, signals in frames if message.name == "Status" and str(signals["state"]) == "fault"]
    table.row("faults reported by any node", len(faults), 0, 0, "")
    two_boards.judge_end(table, console, ended)


if __name__ == "__main__":
    # One processor does the work of two, so it is twice as fast.
    two_boards.test(__doc__, "two_boards", judge, instruction_shift=2, time_out_s=1800.0)
