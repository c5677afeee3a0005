#!/usr/bin/env python3
"""supercoild as a service of systemd, on the emulated board with Debian: which user it runs as, and what follows its end.

It must run as its own user without capabilities and still be punctual, and whatever ends it, systemd must start it
again, disarmed. Prints what was measured; exits with 1 if any of it is wrong, 2 if the board did not do its part.

    tests/hil/service_test.py
"""

import re

import rig
import witness
from table import Table

DECAY_MS = 150.0
MARK_MS = 10.0
SIGTERM_MS = 70.0  # five ticks, and 20 ms for the signal
STEP_MS = 2.0
WATCHDOG_S = 2.0
RESTART_S = 1.0
HOOK_S = 7.0  # until the stop hook has run: this processor needs seconds to start a program


def match_of(console, pattern):
    found = re.search(pattern, console, re.M)
    return found and found[1]


def cold_after(table, run, mark, what, max_ms, zeroed_s, since_edge=False):
    marks, _ = witness.marks_and_reads(run.console)
    looks = witness.looks(run.witness)
    table.row(f"{what}: power before", witness.at(looks, marks[mark] - 0.05).channels[0].power_W, 1.5, 2.5, "W")
    off = witness.first(looks, marks[mark] - MARK_MS / 1e3, lambda look: look.channels[0].power_W == 0)
    since_s = off.edge_s if off is not None and since_edge else marks[mark]
    table.row(f"    off {'after the last edge' if since_edge else 'after'}", None if off is None else (off.time_s - since_s) * 1e3, -MARK_MS,
              max_ms + STEP_MS, "ms")
    zeroed = witness.first(looks, marks[mark] - MARK_MS / 1e3, lambda look: look.channels[0].duty == 0)
    table.row("    the duty of the kernel's PWM is 0 after", None if zeroed is None else zeroed.time_s - marks[mark], -MARK_MS / 1e3, zeroed_s, "s")


def judge(table, run):
    console = run.console
    marks, _ = witness.marks_and_reads(console)
    table.row("the script ended with", run.status, 0, 0, "")
    table.row("Type=notify, and it reported that it was ready", match_of(console, r"^service Type (\w+)") == "notify", 1, 1, "")
    user = int(match_of(console, r"^service user (\d+)"))
    table.row("runs as the user supercoil", int(match_of(console, r"^service uid (\d+)")), max(1, user), user, "")
    table.row("capabilities", int(match_of(console, r"^service capabilities (\w+)"), 16), 0, 0, "")
    table.row("real-time steps that did not work", len(re.findall(r"^journal .*\bnot (?:memory|priority|CPUs|on CPU)", console, re.M)), 0, 0, "")
    table.row("real-time steps that worked", len(re.findall(r"^journal .*(?:memory locked|priority \d+|CPUs kept)", console, re.M)), 3, 20, "")
    table.row("memory locked", int(match_of(console, r"^service locked_KiB (\d+)")) / 1024, 0, 16, "MiB")
    table.row("--off is refused beside it, its process named", bool(re.search(r"^beside .*\b\d+", console, re.M)), 1, 1, "")
    table.row("systemd-analyze security", float(match_of(console, r"^exposure ([\d.]+)") or "nan"), 0, 2.0, "")
    cold_after(table, run, "kill", "SIGKILL", DECAY_MS, HOOK_S, since_edge=True)
    table.row("    started again, disarmed, after", marks["killed_again"] - marks["kill"], RESTART_S, RESTART_S + 16, "s")
    cold_after(table, run, "stopped", "SIGSTOP", DECAY_MS, WATCHDOG_S + HOOK_S, since_edge=True)
    table.row("    systemd's watchdog and a start later disarmed, after", marks["stopped_again"] - marks["stopped"],
              WATCHDOG_S / 2 + RESTART_S, WATCHDOG_S + RESTART_S + 16, "s")
    cold_after(table, run, "sigterm", "systemctl stop, systemd's SIGTERM", SIGTERM_MS, 0.5)
    table.row("    ended by itself, after", marks["stop_ended"] - marks["stop"], 0, 7, "s")
    table.row("    and well", match_of(console, r"^stopped (\w+ \w+)") == "success inactive", 1, 1, "")
    table.row("steps of systemd that timed out", len(re.findall(r"^timed_out ", console, re.M)), 0, 0, "")
    table.row("a wrong configuration: status 2, not tried again", match_of(console, r"^wrong (\w+ \d+ \d+)") == "failed 2 0", 1, 1, "")
    table.row("    and the journal names the key", bool(re.search(r"board\.toml:\d+.*rate_Hz", console)), 1, 1, "")


def main():
    table = Table()
    settings = rig.Settings(share=rig.BUILD / "service_test", watchdog=True, system=True, time_out_s=1200.0)
    run = rig.run(rig.HERE / "scripts" / "service", (), settings)
    table.judge("service", judge, run)
    table.end()


if __name__ == "__main__":
    main()
