"""A copy of the image that toolchain/image made, as a card for the emulated board (rig.Settings.image).

The copy gets the rig's two services and three empty folders, and no login on its console, which is the script's; nothing
else is changed. So what is tested is the image: its boot loader, kernel, set-up and service. The configuration is put on it
as on a PC: into its FAT partition.
"""

import pathlib
import shutil
import struct
import subprocess
import tempfile

import rig

FILE = rig.IMAGE / "supercoil-qemu-arm64.img"
SERVICES = ("rig-hardware.service", "rig.service")


def offsets(card):
    """Where boot, root and data begin, in bytes: from the partition table (MBR)."""
    with open(card, "rb") as file:
        entries = file.read(512)[446:510]
    return [512 * struct.unpack_from("<I", entries, 16 * i + 8)[0] for i in range(3)]


def prepared(name):
    """A fresh copy with the rig on it, in build/hil."""
    if not FILE.exists():
        raise FileNotFoundError(f"{FILE} is missing: run toolchain/image")
    card = rig.BUILD / f"{name}.img"
    subprocess.run(["cp", "--sparse=always", FILE, card], check=True)
    orders = ["mkdir /rig", "mkdir /share", "mkdir /programs",
              "symlink /etc/systemd/system/serial-getty@ttyAMA0.service /dev/null"]
    for service in SERVICES:
        orders += [f"write {rig.HERE / 'guest' / service} /etc/systemd/system/{service}",
                   f"symlink /etc/systemd/system/multi-user.target.wants/{service} ../{service}"]
    debugfs(f"{card}?offset={offsets(card)[1]}", orders)
    return card


def debugfs(file_system, orders):
    """debugfs exits with 0 whatever happens: whatever it prints besides its own echo is an error."""
    with tempfile.NamedTemporaryFile("w") as script:
        script.write("\n".join(orders) + "\n")
        script.flush()
        done = subprocess.run(["/sbin/debugfs", "-w", "-f", script.name, file_system], capture_output=True, text=True, check=True)
    wrong = [line for line in done.stderr.splitlines() if not line.startswith("debugfs 1.")]
    if wrong:
        raise OSError(f"debugfs: {wrong}")


def put_board(card, text):
    """text becomes board.toml of the boot partition; None: there is none."""
    partition = f"{card}@@{offsets(card)[0]}"
    if text is None:
        subprocess.run(["mdel", "-i", partition, "::board.toml"], check=True)
        return
    with tempfile.NamedTemporaryFile("w") as file:
        file.write(text)
        file.flush()
        subprocess.run(["mcopy", "-o", "-i", partition, file.name, "::board.toml"], check=True)


def fill(exchange):
    """What the board's init would bring otherwise: busybox and the drivers of the rig."""
    tree = rig.BUILD / "initramfs"
    shutil.copy(tree / "bin" / "busybox", exchange)
    shutil.rmtree(exchange / "modules", ignore_errors=True)
    shutil.copytree(tree / "lib" / "modules", exchange / "modules")


def run(script, arguments, settings):
    exchange = pathlib.Path(settings.share) / ".rig"
    exchange.mkdir(parents=True, exist_ok=True)
    fill(exchange)
    return rig.run(rig.HERE / "scripts" / script, arguments, settings)
