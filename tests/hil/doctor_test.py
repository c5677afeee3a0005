#!/usr/bin/env python3
"""supercoil doctor on the emulated board: no complaint about a good one, and each of eight faults is named.

Each fault has a board of its own. What is missing must be reported with where doctor looked for it and what is there
instead. The plant's witness, outside of the board, shows that doctor heats nothing. Prints what was found; exits with 1 if
any of it is wrong, 2 if the board did not do its part.

    tests/hil/doctor_test.py [--only FAULT]
"""

import argparse
import json
import re

import rig
import witness
from table import Table

# On every board here the plant has priority over the firmware, as physics must; gpio-sim does not report pulls.
EXPECTED_WARNINGS = {"other programs": r"supercoil-rig-p \(90\) above priority 80",
                     "channel 1, enable released": "low while undriven; its pull is unknown",
                     "channel 2, enable released": "low while undriven; its pull is unknown"}

# For each fault: what must be a problem, how it is reported, and what follows from the fault by itself.
FAULTS = {
    "good": (None, "", {}),
    "no_line": ("stop_circuit",
                r"^no line 'ESTOP' on gpiochip\d 'supercoil-rig': there are 'HEARTBEAT', 'STOP', 'LIGHT', 'ENABLE0'", {}),
    "no_pwm": ("channel 2, pwm", r"^no PWM chip whose path ends with 'i2c-0/0-0040' in /sys/class/pwm: there is none",
               {"channel 1, pwm": "no PWM chip"}),
    "no_converter": ("channel 1, current",
                     r"^no converter whose path ends with 'i2c-0/0-004a' in /sys/bus/iio/devices: there are iio:device0 "
                     r"'ads1015' at /sys/devices/\S*/0-0048, ", {}),
    "rail": ("channel 2, position", r"all of them 32767 counts: stuck at the converter's highest rail$", {}),
    "no_watchdog": ("watchdog", r"^/dev/watchdog: No such file or directory; in /sys/class/watchdog there is none",
                    {}),
    "can_default": (None, "", {}),
    "hot_air": ("air", r"45 to 45 .*: must be 13 to 32 ", {}),
    "enable_up": ("channel 2, enable released", r"^high while undriven; its pull is unknown$", {}),
}
# Warnings because of the fault.
FOLLOWS = {
    # While the plant stands still, so do the values of its sensors.
    "rail": {"channel 1, position": "the same -?[0-9]+ counts each time"},
    # Ten frames are the kernel's default.
    "can_default": {"CAN can0": "^up, 500000 bit/s, queue of 10 frames$"},
    "no_pwm": {f"channel {n}, enable released": "not checked: its duty may not be 0" for n in (1, 2)},
}


def judge_findings(table, label, findings, verdict, expected):
    """Exactly these findings have this verdict."""
    found = {f["what"]: f for f in findings if f["severity"] == verdict}
    for finding in found.values():
        print(f"         {verdict}: {finding['what']}: {finding['found']}\n{'':17} {finding['remedy']}")
    for what, how in expected.items():
        named = what in found and re.search(how, found[what]["found"]) is not None and found[what]["remedy"] != ""
        table.row(f"{label}: {what} is reported as {verdict}", named, 1, 1, "")
    table.row(f"{label}: other {verdict}s", len(found.keys() - expected.keys()), 0, 0, "")


def seen(table, fault, looks):
    """Nothing was heated, even where an enable line rose when it was released."""
    channels = [channel for look in looks for channel in look.channels]
    table.row(f"{fault}: most power that the witness saw", max(c.power_W for c in channels), 0, 0, "W")
    table.row(f"{fault}: highest duty", max(c.duty for c in channels), 0, 0, "")
    table.row(f"{fault}: supply closed, heartbeat's edges", looks[-1].closed + looks[-1].edges, 0, 0, "")
    rises = fault == "enable_up"
    table.row(f"{fault}: an enable was high", max(c.enable for c in channels), rises, rises, "")


def examined(table, fault, run):
    what, how, others = FAULTS[fault]
    problems = {} if what is None else {what: how, **others}
    report = json.loads(re.search(r"^report (.*?)\r?$", run.console, re.M)[1])
    warnings = {**EXPECTED_WARNINGS, **FOLLOWS.get(fault, {})}
    for known in problems:
        warnings.pop(known, None)
    judge_findings(table, fault, report["findings"], "problem", problems)
    judge_findings(table, fault, report["findings"], "warning", warnings)
    status = int(re.search(r"^doctor ended with (\d+)", run.console, re.M)[1])
    table.row(f"{fault}: it ended with", status, bool(problems), bool(problems), "")
    if fault != "rail":  # the plant stands still there, and its witness with it
        seen(table, fault, witness.looks(run.witness))
    if fault == "good":
        for finding in report["findings"]:
            print(f"         {finding['severity']:8} {finding['what']:26} {finding['found']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", choices=FAULTS, help="one of the boards")
    rig.add_architecture(parser)
    args = parser.parse_args()
    table = Table()
    for fault in FAULTS:
        if args.only not in (None, fault):
            continue
        # A direct call has 20 us on a real processor; the usual shift emulates one a fifth as fast.
        settings = rig.Settings(args.architecture, "doctor_test", watchdog=True, can=2 if fault == "can_default" else 0,
                                time_out_s=600.0, instruction_shift=1)
        run = rig.run(rig.HERE / "scripts" / "doctor", (fault,), settings)
        table.judge(fault, lambda t, r: examined(t, fault, r), run)
    table.end()


if __name__ == "__main__":
    main()
