#!/usr/bin/env python3
"""The image for the Raspberry Pi 4, in QEMU's machine of that name: it starts by itself, is set up by its text file, finds
the processor's lines, PWM, watchdog and buses where the example board has them, and names the parts that are not wired.

Prints what was seen; exits with 1 if any of it is wrong, 2 if the board did not do its part. Needs root.

    .venv/bin/python tests/hil/raspberry_pi_test.py
"""

import json
import re
import subprocess
import sys
import time

import image
import raspberry_pi
from table import Table

BOARD = "raspberry-pi-pwm-ads1115.toml"  # of the card's folder boards
CONVERTERS = ("1-0048", "1-0049", "1-004a", "3-0048", "3-0049")


def judge_no_file(table, console):
    text = console.text
    table.row("without board.toml: the console says so", "there is no board.toml on the boot partition" in text, 1, 1, "")
    table.row("    failed is the set-up alone", failed(console) == ["supercoil-set-up.service"], 1, 1, "")
    table.row("    supercoild does not run", console.ask("systemctl is-active supercoild").strip() == "inactive", 1, 1, "")


def failed(console):
    return re.findall(r"^(\S+\.\S+)", console.ask("systemctl --failed --plain --no-legend"), re.M)


def judge_start(table, console):
    table.row("set up by its text file", "two-muscles is set up, can0 at 500000 bit/s" in console.text, 1, 1, "")
    table.row("    the host's name is the board's", console.ask("hostname").strip() == "two-muscles", 1, 1, "")
    table.row("    the kernel is real-time", "PREEMPT_RT" in console.ask("uname -v"), 1, 1, "")
    table.row("    isolated is the last CPU", console.ask("cat /sys/devices/system/cpu/isolated").strip() == "3", 1, 1, "")
    mounts = {where: options.split(",")[0] for where, options in re.findall(
        r"^\S+ (\S+) (?:ext4|vfat) (\S+)", console.ask("cat /proc/mounts"), re.M)}
    table.row("    boot and root read, learned written",
              mounts == {"/": "ro", "/boot/firmware": "ro", "/var/lib/supercoil": "rw"}, 1, 1, "")


def judge_wiring(table, console):
    """What the device tree gave the kernel."""
    lines = console.ask("gpioinfo pinctrl-bcm2711")
    table.row("lines with the example's names", sum(f'"{name}"' in lines for name in ("GPIO17", "GPIO22", "GPIO23", "GPIO24", "GPIO27")),
              5, 5, "")
    table.row("the PWM, with both outputs", int(console.ask(f"cat /sys/devices/platform/soc/{raspberry_pi.PWM_HERE}/pwm/pwmchip*/npwm")), 2, 2, "")
    devices = console.ask("for d in /sys/bus/i2c/devices/*; do echo ${d##*/} $(cat $d/name); done")
    table.row("converters known to the kernel, at their addresses", sum(f"{name} ads1115" in devices for name in CONVERTERS), 5, 5, "")
    table.row("    on buses with their numbers", sum(int(console.ask(f"ls -d /sys/bus/i2c/devices/i2c-{bus} | wc -l")) for bus in (1, 3)), 2, 2, "")
    table.row("the CAN controller, known to the kernel",
              console.ask("cat /sys/bus/spi/devices/spi*/modalias").strip() == "spi:mcp2515", 1, 1, "")
    table.row("its crystal, which config.txt may change", hertz(console), 16e6, 16e6, "Hz")


def hertz(console):
    tree = "/sys/firmware/devicetree/base"
    if "clock-frequency:0" not in console.ask(f"tr -d '\\000-\\037' <{tree}/__overrides__/can_crystal"):
        return None
    return int(console.ask(f"od -An -tu4 --endian=big {tree}/can-crystal/clock-frequency"))


def judge_missing(table, console):
    """What is not wired is named; everything else is in its place."""
    console.ask("systemctl stop supercoild")
    journal = console.ask("journalctl -b -u supercoild -o cat")
    table.row("supercoild names the converters that are missing",
              sum(f"no converter whose path ends with 'i2c-{name[0]}/{name}'" in journal for name in CONVERTERS), 5, 5, "")
    table.row("    and starts nothing", "nothing was started" in journal, 1, 1, "")
    findings = {finding["what"]: finding for finding in json.loads(console.ask("supercoil doctor --json 2>/dev/null"))["findings"]}
    for what in ("kernel", "priority", "frequency", "processors", "watchdog"):
        table.row(f"doctor: {what} in order", findings[what]["severity"] == "ok", 1, 1, "")
    table.row("    clocks at their highest", "governor 'performance'" in findings["frequency"]["found"], 1, 1, "")
    # How long a call takes is QEMU's affair.
    for what, line in (("heartbeat", "GPIO17"), ("light", "GPIO22"), ("channel 1, enable", "GPIO23"), ("channel 2, enable", "GPIO24")):
        table.row(f"doctor: {what} is there, low", findings[what]["found"].startswith(f"{line} of pinctrl-bcm2711, low"), 1, 1, "")
    table.row("doctor: outputs of the PWM that took period and duty",
              sum("took its period of 1000000 ns" in findings[f"channel {n}, pwm"]["found"] for n in (1, 2)), 2, 2, "")
    table.row("doctor: what is missing is a problem", sum(
        findings[what]["severity"] == "problem" for what in ("CAN can0", "supply", *(
            f"channel {n}, {part}" for n in (1, 2) for part in ("position", "current")))), 6, 6, "")


def judge_emergency(table, console):
    table.row("without its boot partition: who is at the console gets in", console.ask("whoami").strip() == "root", 1, 1, "")
    table.row("    supercoild does not run", console.ask("systemctl is-active supercoild").strip() == "inactive", 1, 1, "")


def look(table, card, name, *parts):
    begin = time.monotonic()
    with raspberry_pi.board(card) as console:
        print(f"      {name}: a shell after {time.monotonic() - begin:.0f} s of this machine")
        for part in parts:
            part(table, console)


def main():
    table = Table()
    try:
        card = raspberry_pi.prepared()
        look(table, card, "no board.toml", judge_no_file)
        example = raspberry_pi.from_boot(card, f"boards/{BOARD}").read_text()
        image.put_board(card, example.replace(raspberry_pi.PWM, raspberry_pi.PWM_HERE))
        look(table, card, BOARD, judge_start, judge_wiring, judge_missing)
        raspberry_pi.rename_boot(card, "OTHER")
        look(table, card, "no boot partition", judge_emergency)
    except (OSError, EOFError, ValueError, KeyError, subprocess.CalledProcessError) as error:
        print(f"raspberry_pi_test: {error!r}", file=sys.stderr)
        sys.exit(2)
    table.end()


if __name__ == "__main__":
    main()
