"""Boots the emulated board and runs a script on it (boot is the command; tests import this).

The shared folder is /share on the board. In its .rig the host puts what the board needs to begin (command, functions)
and finds the results: status, console, witness.
"""

import contextlib
import dataclasses
import fcntl
import os
import pathlib
import selectors
import shlex
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent
BUILD = ROOT / "build" / "hil"  # of arm64
IMAGE = ROOT / "build" / "image"

# How a run ended, when not by its script.
TIMED_OUT = 124
DIED = 125


@dataclasses.dataclass(frozen=True)
class Architecture:
    """What differs between the boards here; prepare has the rest."""

    build: pathlib.Path  # what prepare made, and what the tests leave
    programs: pathlib.Path
    machine: tuple
    console: str


ARCHITECTURES = {
    "arm64": Architecture(BUILD, ROOT / "build" / "arm64" / "bin",
                          ("qemu-system-aarch64", "-M", "virt,gic-version=3", "-cpu", "cortex-a53"), "ttyAMA0"),
    "amd64": Architecture(ROOT / "build" / "hil-amd64", ROOT / "build" / "release" / "bin",
                          ("qemu-system-x86_64", "-M", "q35", "-cpu", "max"), "ttyS0"),
}


def add_architecture(parser):
    parser.add_argument("--architecture", choices=ARCHITECTURES, default="arm64", help="of the board (default: arm64)")


@dataclasses.dataclass
class Settings:
    """What the board is, besides its script."""

    architecture: str = "arm64"
    share: pathlib.Path | str = "share"  # a name is that of a folder in the architecture's own
    time_out_s: float = 120.0  # host time; the guest's is not known
    watchdog: bool = False  # an i6300esb: /dev/watchdog; not fed, it switches the board off
    can: int = 0  # controllers on one bus: can0, can1, ...
    system: bool = False  # Debian's systemd from a disk, with supercoild as its service
    image: pathlib.Path | None = None  # boots this card by U-Boot instead (image.py); what is written stays
    disk: pathlib.Path | None = None  # a disk of its own, not of system or image: /dev/vda; what is written stays
    write_log: pathlib.Path | None = None  # with disk: gets all that is written to it (write_log.py)
    cpus: int = 1  # several only with free_running: counted instructions need one
    free_running: bool = False  # the guest's time is the host's: latencies then mean nothing
    instruction_shift: int = 3  # an instruction lasts 2^shift ns of the guest's time
    kernel_options: str = ""
    echo: bool = False  # the console on standard output too

    def __post_init__(self):
        self.share = self.board.build / self.share

    @property
    def board(self):
        return ARCHITECTURES[self.architecture]


@dataclasses.dataclass
class Run:
    status: int  # of the script; TIMED_OUT; DIED: the board went off before the script's end
    console: str
    witness: list  # lines of the plant (plant/witness.hpp), as text
    wall_s: float


def qemu_command(settings):
    clock = [] if settings.free_running else [
        # Time is counted in instructions, so that it does not depend on the host's load; it jumps
        # when the board sleeps. The guest's date begins at the same moment in every run.
        "-icount", f"shift={settings.instruction_shift},align=off,sleep=off", "-rtc", "base=2026-01-01,clock=vm"]
    exchange = settings.share / ".rig"
    command = [
        *settings.board.machine, "-accel", "tcg", "-smp", str(settings.cpus),
        "-m", "512", "-nodefaults", "-no-user-config", "-nographic", "-monitor", "none", "-no-reboot", "-net", "none",
        *clock, "-serial", "stdio", *start_command(settings),
        "-fsdev", f"local,id=share,path={settings.share},security_model=none",
        "-device", "virtio-9p-pci,fsdev=share,mount_tag=share",
        "-fsdev", f"local,id=programs,path={settings.board.programs},security_model=none,readonly=on",
        "-device", "virtio-9p-pci,fsdev=programs,mount_tag=programs",
        # No event loop between the board's write and the file: the board does not wait for it,
        # and a line that was written is there whatever the board does next.
        "-chardev", f"file,id=witness,path={exchange / 'witness'}",
        "-device", "virtio-serial-pci,ioeventfd=off", "-device", "virtserialport,chardev=witness,name=witness"]
    if settings.watchdog:
        command += ["-device", "i6300esb", "-watchdog-action", "poweroff"]
    if settings.system:
        # What the board writes is forgotten with it.
        command += ["-drive", f"file={settings.board.build / 'system.ext4'},if=none,id=disk,format=raw,snapshot=on",
                    "-device", "virtio-blk-pci,drive=disk"]
    if settings.disk:
        command += disk_options(settings.disk, settings.write_log)
    if settings.can:
        command += ["-object", "can-bus,id=bus", *(settings.can * ["-device", "kvaser_pci,canbus=bus"])]
    return command


def disk_options(disk, write_log):
    """The board's flushes need not reach this machine's disk: it only has to survive the end of QEMU, which loses nothing."""
    def file(name, path):
        return ["-blockdev", f"driver=raw,node-name={name},cache.no-flush=on,file.driver=file,file.filename={path}"]
    options = file("content", disk)
    if write_log:
        options += [*file("log", write_log), "-blockdev", "driver=blklogwrites,node-name=logged,file=content,log=log"]
    return [*options, "-device", f"virtio-blk-pci,drive={'logged' if write_log else 'content'}"]


def start_command(settings):
    """What the board boots from, and by what."""
    if settings.image:
        card = f"driver=raw,node-name=card,file.driver=file,file.filename={settings.image}"
        return ["-bios", str(IMAGE / "u-boot.bin"), "-blockdev", card, "-device", "virtio-blk-pci,drive=card"]
    board = settings.board
    return ["-kernel", str(board.build / "vmlinuz"), "-initrd", str(board.build / "initramfs.cpio"),
            # Without kaslr the kernel keeps its own page tables in system calls, and QEMU its cache of them:
            # a run costs this machine half the time, and is repeatable.
            "-append", f"console={board.console} quiet panic=-1 nokaslr mitigations=off {settings.kernel_options}"]


def fill_share(settings, script, arguments):
    exchange = settings.share / ".rig"
    for old in ("status", "witness", "console", "system"):
        (exchange / old).unlink(missing_ok=True)
    if settings.system:
        (exchange / "system").touch()
    for file in (HERE / "guest").iterdir():
        shutil.copy(file, exchange)
    shutil.copy(HERE / "board.toml", exchange)
    shutil.copy(script, exchange / "script")
    (exchange / "command").write_text("exec sh /rig/script " + shlex.join(arguments) + "\n")


@contextlib.contextmanager
def alone_in(share):
    """Two boards in one folder would read each other's orders."""
    (share / ".rig").mkdir(parents=True, exist_ok=True)
    with open(share / ".rig" / "lock", "w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise BlockingIOError(f"another board runs in {share}: choose another folder (--share)") from None
        yield


def follow(process, deadline, echo):
    """The console until the board is off, and whether that was before the deadline."""
    text = bytearray()
    with selectors.DefaultSelector() as selector:
        selector.register(process.stdout, selectors.EVENT_READ)
        while (left := deadline - time.monotonic()) > 0:
            if not selector.select(left):
                continue
            block = os.read(process.stdout.fileno(), 65536)
            if not block:
                return bytes(text), True
            text += block
            if echo:
                sys.stdout.buffer.write(block)
                sys.stdout.buffer.flush()
    return bytes(text), False


def run(script, arguments=(), settings=None):
    settings = settings or Settings()
    board = settings.board
    for needed in (*(board.build / name for name in ("vmlinuz", "initramfs.cpio", *(["system.ext4"] if settings.system else []))),
                   board.programs):
        if not needed.exists():
            raise FileNotFoundError(f"{needed} is missing: run tests/hil/prepare --architecture {settings.architecture}")
    if settings.image and not (IMAGE / "u-boot.bin").exists():
        raise FileNotFoundError(f"{IMAGE} is missing: run toolchain/image")
    with alone_in(settings.share):
        fill_share(settings, pathlib.Path(script), [str(argument) for argument in arguments])
        return boot(settings)


def boot(settings):
    exchange = settings.share / ".rig"
    start = time.monotonic()
    with subprocess.Popen(qemu_command(settings), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT) as process:
        try:
            console, ended = follow(process, start + settings.time_out_s, settings.echo)
        finally:
            if process.poll() is None:
                process.kill()
    wall_s = time.monotonic() - start
    (exchange / "console").write_bytes(console)
    if not ended:
        status = TIMED_OUT
    else:
        try:
            status = int((exchange / "status").read_text())
        except (FileNotFoundError, ValueError):
            status = DIED
    witness = exchange / "witness"
    lines = witness.read_text(errors="replace").splitlines() if witness.exists() else []
    return Run(status, console.decode(errors="replace"), lines, wall_s)
