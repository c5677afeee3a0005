"""What was received and reported on the firmware's CAN bus on the emulated board (scripts/can)."""

import re

import witness

LOOK_S = 0.1  # how often it looks whether an interface is back
SOON_S = 0.1  # a command of the shell, and what it runs


def frames(console, log):
    """(data, seconds) of each received frame."""
    return [(data, float(time))
            for data, time in re.findall(rf"^{log} frame \w+ \w+ (\w+|-) ([\d.]+)\r?$", console, re.M)]


def states(console, log):
    """(state, seconds) of each change."""
    return [(state, float(time)) for state, time in re.findall(rf"^{log} state \w+ (\w+) ([\d.]+)\r?$", console, re.M)]


def after(reports, state, begin_s):
    """How long after `begin_s` the first of this state or data was reported; None: never."""
    return next((time - begin_s for what, time in reports if what == state and time >= begin_s - 0.01), None)


def can(table, run):
    marks, _ = witness.marks_and_reads(run.console)
    sent = {log: [int(n) for n in counts.split()]
            for log, counts in re.findall(r"^(\w+) sent can\d ([\d ]+)\r?$", run.console, re.M)}
    for sender, receiver, way in (("second", "first", "can1 to can0"), ("first", "second", "can0 to can1")):
        ok, busy, gone = sent[sender]
        # The first byte counts the frames sent; the listener may begin before or after the sender.
        numbers = [int(data[:2], 16) for data, _ in frames(run.console, receiver)]
        table.row(f"CAN, {way}, both ways at once: received", len(numbers), 100, ok, "")
        table.row("           left out between them", sum((b - a) % 256 - 1 for a, b in zip(numbers, numbers[1:])), 0, 0, "")
        table.row("           refused to send", busy + gone, 0, 0, "")

    received = frames(run.console, "filter")
    table.row("CAN filter: other identifiers, extended and remote frames received",
              sum(data in ("02", "03", "04", "-") for data, _ in received), 0, 0, "")
    table.row("           the right ones, of four", sum(data in ("01", "05", "06", "07") for data, _ in received), 4, 4, "")
    table.row("           a frame that waited 0.5 s: received after", after(received, "06", marks["waits"]), -0.01, 0.1, "s")
    link = states(run.console, "filter")
    table.row("can0 set down: reported after", after(link, "down", marks["link_down"]), 0, 0.1, "s")
    table.row("           set up again: active after", after(link, "active", marks["link_up"]), 0, LOOK_S + SOON_S, "s")
    table.row("an interface that is not there: names those that there are",
              "missing supercoil-rig-can: no CAN interface 'can7': there are can0, can1" in run.console, 1, 1, "")

    virtual = states(run.console, "virtual")
    for mark, state in (("passive", "error_passive"), ("off", "bus_off"), ("restarted", "active")):
        table.row(f"error frame: {state} after", after(virtual, state, marks[mark]), 0, SOON_S, "s")
    table.row("interface vanished: down after", after(virtual, "down", marks["vanished"]), 0, 0.2, "s")
    table.row("           came back: active after", after(virtual, "active", marks["returned"]), 0, LOOK_S + SOON_S, "s")
    table.row("           receives again", sum(data == "08" for data, _ in frames(run.console, "virtual")), 1, 1, "")
