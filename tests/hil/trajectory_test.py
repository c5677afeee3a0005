#!/usr/bin/env python3
"""Two boards on one CAN bus play one motion in step, for a minute; again while the clock of the second is faster by
100 ppm; then their sender is stopped midway. Finally one plays a motion by its own socket.

Both tick at 1 kHz, by timers of their own; the plants' witness sees them to 1 ms. The lag of one behind the other is
the time by which its true position is late, by least squares. Both have the same muscle; what their controllers learn
at first appears as a lag too. How well their clocks agree shows in the references that they report, which do not
depend on controllers and plants.
Prints what was measured; exits with 1 if any of it is wrong, 2 if the boards did not do their part.

    .venv/bin/python tests/hil/trajectory_test.py [--architecture amd64]
"""

import math
import re

import cantools
import numpy as np

import rig
import two_boards
import witness

DURATION_S = 60.0
KNOTS_PER_S = 50
COMMAND_EXPIRES_MS = 250.0
DRIFT_PPM = 100.0  # scripts/trajectory: 6 ms in a minute, if nothing brought them together
CLOCKS_MS = 0.1  # how far they may drift apart
LAG_MS = 2.0  # ticks of 1 ms and steps of a plant of 1 ms, each with any phase


def motion_m(time_s):
    """From standstill to standstill; quick parts show delays best."""
    fade = 0.5 - 0.5 * math.cos(math.pi * min(1.0, time_s / 2.0, (DURATION_S - time_s) / 2.0))
    return 7e-3 + fade * (1e-3 * math.sin(0.4 * math.pi * time_s) + 0.15e-3 * math.sin(2 * math.pi * time_s))


def write_motion(path):
    rows = [f"{i / KNOTS_PER_S:.3f},{x:.7f},{x:.7f}"
            for i in range(int(DURATION_S * KNOTS_PER_S) + 1) for x in [motion_m(i / KNOTS_PER_S)]]
    path.write_text("\n".join(["time_s,5:position_m,9:position_m", *rows]) + "\n")


def true_positions_m(looks, times_s):
    return np.interp(times_s, [look.time_s for look in looks], [look.channels[0].position_m for look in looks])


def lag_ms(first, second, begin_s, end_s):
    """How far the second is behind the first."""
    times_s = np.arange(begin_s, end_s, 0.001)
    ahead, behind = true_positions_m(first, times_s), true_positions_m(second, times_s)
    return lag_of_columns_ms(times_s, ahead, behind)


def lag_of_columns_ms(times_s, ahead, behind):
    columns = np.column_stack([np.gradient(ahead, times_s), np.ones_like(times_s)])
    return 1e3 * np.linalg.lstsq(columns, ahead - behind, rcond=None)[0][0]


def frames_named(log, name):
    """Time, node and signals of each frame of this message in the bus's log."""
    message = cantools.database.load_file(rig.ROOT / "firmware" / "io" / "can" / "supercoil.dbc").get_message_by_name(name)
    for time, identifier, data in re.findall(r"^\(([\d.]+)\) \w+ ([0-9A-F]{3})#([0-9A-F]*)", log, re.M):
        if int(identifier, 16) & ~0x3F == message.frame_id & ~0x3F:
            yield float(time), int(identifier, 16) & 0x3F, message.decode(bytes.fromhex(data), decode_choices=False)


def reference_lags_ms(log):
    """For each motion of a minute, every ten seconds: how far the second's reference is behind the first's."""
    references = {5: [], 9: []}
    for time_s, node, signals in frames_named(log, "Tracking"):
        if node in references:
            references[node].append((time_s, signals["reference_m"]))
    (times_s, first_m), (of_second_s, second_m) = (np.array(rows).T for rows in references.values())
    second_m = np.interp(times_s, of_second_s, second_m)
    syncs_s = [time_s for time_s, _, _ in frames_named(log, "Sync")]
    begins_s = [after for before, after in zip([-math.inf, *syncs_s], syncs_s) if after - before > 1.5]
    lags_ms = []
    for begin_s in begins_s[:2]:
        pieces = [(times_s >= begin_s + at_s) & (times_s < begin_s + at_s + 10.0) for at_s in np.arange(3.0, 53.0, 10.0)]
        lags_ms.append([lag_of_columns_ms(times_s[piece], first_m[piece], second_m[piece]) for piece in pieces])
    return lags_ms


def judge_step(table, which, first, second, end_s, lags_ms):
    """Judges a motion that ended at end_s."""
    times_s = np.arange(end_s - DURATION_S + 1.0, end_s - 1.0, 0.001)
    apart_m = true_positions_m(first, times_s) - true_positions_m(second, times_s)
    moved_mm = 1e3 * np.ptp(true_positions_m(first, times_s))
    table.row(f"{which}: the motion", moved_mm, 2.0, 2.4, "mm")
    table.row("    the second is behind", lag_ms(first, second, times_s[0], times_s[-1]), -LAG_MS, LAG_MS, "ms")
    middle_s = end_s - DURATION_S / 2
    table.row("    over its first half", lag_ms(first, second, times_s[0], middle_s), -LAG_MS, LAG_MS, "ms")
    table.row("    over its second half", lag_ms(first, second, middle_s, times_s[-1]), -LAG_MS, LAG_MS, "ms")
    table.row("    how far they are apart, rms", 1e6 * np.sqrt(np.mean(apart_m ** 2)), 0, 20, "um")
    table.row("    the reference of the second is behind", np.mean(lags_ms), -LAG_MS, LAG_MS, "ms")
    table.row("    and this changes by", np.ptp(lags_ms), 0, CLOCKS_MS, "ms")


def judge(table, run, share):
    marks, _ = witness.marks_and_reads(run.console)
    console = run.console.replace("\r", "")
    ended = two_boards.exit_statuses(console)
    two_boards.judge_begin(table, run, ended)
    table.row("play ended with", ended["played"], 0, 0, "")
    first, second = two_boards.looks(run, share)
    lags_ms = reference_lags_ms((share / "can.log").read_text())
    judge_step(table, "of one clock", first, second, marks["played"], lags_ms[0])
    drift = re.search(r"^drift ([\d.]+)$", console, re.M)
    table.row("the clock of the second is faster by", float(drift[1]) if drift else None, DRIFT_PPM, DRIFT_PPM, "ppm")
    table.row("with two clocks play ended with", ended["drifted"], 0, 0, "")
    judge_step(table, f"of clocks {DRIFT_PPM:g} ppm apart", first, second, marks["drifted"], lags_ms[1])
    for name, looks in (("first", first), ("second", second)):
        heated = witness.at(looks, marks["stopped"]).channels[0].power_W
        table.row(f"the sender is stopped: the {name} was heated with", heated, 0.3, 4.5, "W")
        off = witness.first(looks, marks["stopped"], lambda look: look.channels[0].power_W == 0)
        table.row("    and is off after", (off.time_s - marks["stopped"]) * 1e3, 100, COMMAND_EXPIRES_MS + 50, "ms")
        again = [look for look in looks if off.time_s < look.time_s < marks["after"] and look.channels[0].power_W > 0.01]
        table.row("    it was heated again, looks", len(again), 0, 0, "")
    for node in (5, 9):
        table.row(f"node {node} reports command_timeout", len(re.findall(rf"^seen {node} .*command_timeout", console, re.M)), 1, 1, "")
    table.row("by its own socket play ended with", ended["local"], 0, 0, "")
    moved = [look.channels[0].position_m for look in first if marks["alone"] <= look.time_s <= marks["alone_played"]]
    table.row("    the muscle came to", 1e3 * max(moved), 7.3, 7.6, "mm")
    two_boards.judge_end(table, console, ended)


if __name__ == "__main__":
    # One processor does the work of two at 1 kHz, so it is eight times as fast.
    two_boards.test(__doc__, "trajectory", judge, prepare=lambda share: write_motion(share / "motion.csv"),
                    instruction_shift=0, time_out_s=3600.0)
