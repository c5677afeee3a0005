"""The image for the Raspberry Pi 4 in QEMU's machine of that name, over its serial console.

QEMU does not run the Raspberry Pi's firmware: what that would read from the boot partition (config.txt, cmdline.txt) is read
here. Parts that QEMU lacks, and without which Debian's kernel stops, are taken out of the device tree, or moved.
"""

import contextlib
import os
import pathlib
import re
import selectors
import signal
import subprocess
import time

import image
import rig

FILE = rig.IMAGE / "supercoil-raspberry-pi-4-arm64.img"
FOLDER = rig.ROOT / "build" / "raspberry-pi"
CARD_BYTES = 2 << 30  # QEMU's cards are powers of two
NOT_IN_QEMU = (
    # HDMI
    "/soc/clock@7ef00000", "/soc/interrupt-controller@7ef00100", "/soc/hdmi@7ef00700", "/soc/hdmi@7ef05700",
    "/soc/i2c@7ef04500", "/soc/i2c@7ef09500",
    # The card, and its supply, which the firmware switches. QEMU has its card where a Raspberry Pi 4 has its WLAN.
    "/emmc2bus/mmc@7e340000", "/sd_io_1v8_reg", "/sd_vcc_reg",
    # The small UART: with a real-time kernel QEMU's interrupts of it leave no time for the card's. Bluetooth's takes its place.
    "/soc/serial@7e215040")
BLUETOOTH = "/soc/serial@7e201000/bluetooth"
CARD = "/soc/mmc@7e300000"
# What the board file needs and QEMU has elsewhere: the third I2C bus of older Raspberry Pis and, for the PWM, registers
# that ignore what is written (of I2S).
MOVED = {"/soc/i2c@7e205600": ("7e805000", "200"), "/soc/pwm@7e20c000": ("7e203000", "28")}
PWM, PWM_HERE = "fe20c000.pwm", "fe203000.pwm"  # which thus has another name


def prepared():
    """A fresh copy of the image, as a card."""
    if not FILE.exists():
        raise FileNotFoundError(f"{FILE} is missing: run toolchain/image raspberry-pi-4")
    FOLDER.mkdir(parents=True, exist_ok=True)
    card = FOLDER / "card.img"
    subprocess.run(["cp", "--sparse=always", FILE, card], check=True)
    os.truncate(card, CARD_BYTES)
    return card


def from_boot(card, name):
    """A file of the boot partition, in FOLDER."""
    subprocess.run(["mcopy", "-o", "-i", f"{card}@@{image.offsets(card)[0]}", f"::{name}", FOLDER], check=True)
    return FOLDER / pathlib.Path(name).name


def options(card):
    """QEMU's options that do what the firmware would do."""
    config = from_boot(card, "config.txt").read_text()
    tree = from_boot(card, "bcm2711-rpi-4-b.dtb")
    for node in NOT_IN_QEMU:
        subprocess.run(["fdtput", "-t", "s", tree, node, "status", "disabled"], check=True)
    subprocess.run(["fdtput", "-d", tree, CARD, "mmc-pwrseq", "non-removable"], check=True)
    subprocess.run(["fdtput", "-r", tree, f"{CARD}/wifi@1", BLUETOOTH], check=True)
    for node, registers in MOVED.items():
        subprocess.run(["fdtput", "-t", "x", tree, node, "reg", *registers], check=True)
    inside = f"/supercoil/{FOLDER.relative_to(rig.ROOT)}"
    kernel = from_boot(card, re.search(r"^kernel=(\S+)", config, re.M)[1]).name
    initramfs = from_boot(card, re.search(r"^initramfs (\S+)", config, re.M)[1]).name
    return ["-kernel", f"{inside}/{kernel}", "-initrd", f"{inside}/{initramfs}", "-dtb", f"{inside}/{tree.name}",
            "-append", from_boot(card, "cmdline.txt").read_text().strip().replace("ttyS1", "ttyAMA0"),
            "-drive", f"file={inside}/{card.name},if=sd,format=raw", "-serial", "stdio"]


PROMPT = r"root@\S+:~#"
EMERGENCY = "Press Enter for maintenance"


class Console:
    """What the board says, and a shell on it."""

    def __init__(self, process):
        self.process = process
        self.text = ""
        self.selector = selectors.DefaultSelector()
        self.selector.register(process.stdout, selectors.EVENT_READ)

    def wait_for(self, pattern, time_out_s, begin=0):
        deadline = time.monotonic() + time_out_s
        while not (found := re.compile(pattern).search(self.text, begin)):
            left = deadline - time.monotonic()
            if left <= 0 or not self.selector.select(left):
                raise TimeoutError(f"no {pattern!r} within {time_out_s:g} s:\n{self.text[-3000:]}")
            block = os.read(self.process.stdout.fileno(), 65536)
            if not block:
                raise EOFError(f"QEMU ended:\n{self.text[-3000:]}")
            self.text += block.decode(errors="replace").replace("\r", "")
            (FOLDER / "console").write_text(self.text)
        return found

    def press_enter_until(self, pattern, presses=20, each_s=5.0):
        """Repeatedly: what is typed before the other end reads may be thrown away."""
        for _ in range(presses):
            self.process.stdin.write(b"\n")
            self.process.stdin.flush()
            with contextlib.suppress(TimeoutError):
                return self.wait_for(pattern, each_s)
        raise TimeoutError(f"no {pattern!r} after {presses} times Enter")

    def ask(self, command, time_out_s=180):
        """What the command prints there."""
        begin = len(self.text)
        # The shell's echo of the line contains neither word whole.
        self.process.stdin.write(f"echo =be''gin=; {command}; echo =e''nd=\n".encode())
        self.process.stdin.flush()
        return self.wait_for(r"(?s)=begin=\n(.*?)=end=\n", time_out_s, begin)[1]


def rename_boot(card, label):
    subprocess.run(["mlabel", "-i", f"{card}@@{image.offsets(card)[0]}", f"::{label}"], check=True)


@contextlib.contextmanager
def board(card, time_out_s=900):
    """Powered on, up to the shell on its serial console; powered off at the end, by pulling the plug."""
    process = subprocess.Popen([rig.HERE / "raspberry_pi_boot", FOLDER.relative_to(rig.ROOT), *options(card)],
                               stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               start_new_session=True)
    try:
        console = Console(process)
        if console.wait_for(f"{PROMPT}|{EMERGENCY}", time_out_s)[0] == EMERGENCY:
            console.press_enter_until(PROMPT)
        console.ask("export SYSTEMD_PAGER= TERM=dumb")
        yield console
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
