#!/usr/bin/env python3
"""Power cuts while a board stores what it learned: afterwards the disk has what was stored, or what was being stored.

supercoild heats on the emulated board and stores a scale again and again, on ext4 of the board's kernel, while QEMU
records what is written to the disk. Then the power goes off at random places of that record: what the disk had confirmed
by a flush is there, any part of what was written since then may be, and the write under way may be torn. On each
resulting disk the file system is checked as at a start, and the learned files are read. Exits with 1 if any of them lost
something, 2 if the board did not do its part.

    tests/hil/power_cut_test.py [--stores N] [--cuts N] [--seed N] [--replay]
"""

import argparse
import collections
import random
import re
import subprocess
import sys
import zlib

import rig
import write_log

FILE_SYSTEM_MiB = 256  # as the third partition of the image
MARK_OFFSET = FILE_SYSTEM_MiB << 20  # scripts/stores writes there what is known to be stored
DISK = rig.BUILD / "power_cut.ext4"
BEFORE = rig.BUILD / "power_cut_before.ext4"
LOG = rig.BUILD / "power_cut.log"


def record(stores):
    """Leaves in BEFORE the disk as it was, in LOG all that was written to it."""
    for file in (BEFORE, LOG):
        file.unlink(missing_ok=True)
        file.touch()
    subprocess.run(["/sbin/mke2fs", "-q", "-t", "ext4", BEFORE, f"{FILE_SYSTEM_MiB}M"], check=True)
    with open(BEFORE, "r+b") as file:
        file.truncate(MARK_OFFSET + write_log.SECTOR)
    subprocess.run(["cp", "--sparse=always", BEFORE, DISK], check=True)
    settings = rig.Settings(share=rig.BUILD / "power_cut_test", watchdog=True, disk=DISK, write_log=LOG, time_out_s=3600.0)
    run = rig.run(rig.HERE / "scripts" / "stores", (stores, MARK_OFFSET // write_log.SECTOR), settings)
    if run.status != 0:
        print(f"{run.console}\npower_cut_test: the board did not do its part: {run.status}", file=sys.stderr)
        sys.exit(2)
    print(f"      recorded: {run.wall_s:.1f} s of this machine")


def whole(text):
    """The version of a learned file, if it is what its first line says (docs/storage.md); None: damaged or not there."""
    head, _, body = text.partition(b"\n")
    found = re.fullmatch(rb"# supercoil learned, format 2, (\d+) bytes, CRC-32 ([0-9a-f]{8})", head)
    if not found or len(body) != int(found[1]) or zlib.crc32(body) != int(found[2], 16):
        return None
    return int(re.search(rb"^version = (\d+)$", body, re.M)[1])


def learned(disk):
    """(current, previous) versions after the check that a start makes, and what that check could not repair."""
    checked = subprocess.run(["/sbin/e2fsck", "-p", disk], capture_output=True, text=True)
    damage = "" if checked.returncode <= 1 else f"e2fsck ended with {checked.returncode}: {checked.stdout.strip()}"
    current, previous = (whole(subprocess.run(["/sbin/debugfs", "-R", f"cat /learned-1.toml{suffix}", disk],
                                              capture_output=True, check=True).stdout) for suffix in ("", ".previous"))
    return current, previous, damage


def stored_version(write):
    """The version that was known to be stored when this was written, or None."""
    return int(write.data[7:15]) if write.offset == MARK_OFFSET and write.data.startswith(b"stored ") else None


def cut_power(writes, cut, chance):
    """Leaves in DISK what a cut before writes[cut] leaves; how many writes were lost."""
    subprocess.run(["cp", "--sparse=always", BEFORE, DISK], check=True)
    left, lost = write_log.left_by_cut(writes, cut, chance)
    with open(DISK, "r+b") as file:
        for offset, data in left:
            file.seek(offset)
            file.write(data)
    return lost


def judge(known, current, previous, damage):
    """What is wrong, or nothing. One store at a time is under way, and two versions are kept at every moment."""
    if damage:
        return damage
    if current is None or previous is None:
        return "damaged or not there"
    if not known <= current <= known + 1:
        return "another version than the last that was stored, or the one after it"
    return "" if previous < current else "the one before it is none before it"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--stores", type=int, default=100)
    parser.add_argument("--cuts", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--replay", action="store_true", help="cuts the last record again")
    args = parser.parse_args()
    if not args.replay:
        record(args.stores)
    writes = write_log.read(LOG)
    marks = [(place, stored_version(write)) for place, write in enumerate(writes) if stored_version(write) is not None]
    flushes = sum(bool(write.flags & write_log.FLUSH) for write in writes)
    print(f"      record: {len(writes) - flushes} writes, {flushes} flushes; versions {marks[0][1]} to {marks[-1][1]}")
    chance, count = random.Random(args.seed), collections.Counter()
    for number in range(1, args.cuts + 1):
        cut = chance.randrange(marks[0][0] + 1, len(writes))
        known = max(version for place, version in marks if place < cut)
        lost = cut_power(writes, cut, chance)
        current, previous, damage = learned(DISK)
        wrong = judge(known, current, previous, damage)
        count.update(wrong=bool(wrong), newer=current == known + 1, unsafe=lost > 0, lost=lost)
        print(f"{'WRONG' if wrong else 'ok   '} cut {number:4} at {cut:6}: {lost:3} writes lost; version {known} was stored; "
              f"found {current}, and {previous} before it {wrong}", flush=True)
    print(f"{args.cuts} power cuts: {count['wrong']} lost something; {count['newer']} found the version that was being stored; "
          f"{count['unsafe']} lost writes that the disk had not confirmed, {count['lost']} in all")
    sys.exit(1 if count["wrong"] else 0)


if __name__ == "__main__":
    main()
