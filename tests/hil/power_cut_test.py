#!/usr/bin/env python3
"""Power cuts while the image stores what a muscle taught it: what was stored is there, or what was being stored.

A board stores again and again while QEMU records what it writes to its card. Then the power goes off at random places of
that record: of what the card had not been told to make durable, any part is lost and the last write may be torn. Each
time the file system is checked as at a start, and the learned file read. Prints each cut; ends with 1 if any lost
something.

    .venv/bin/python tests/hil/power_cut_test.py [--stores N] [--cuts N] [--seed N]
"""

import argparse
import random
import re
import subprocess
import sys
import zlib

import image
import image_test
import rig
import write_log

MARK_OFFSET = 64 * 512  # scripts/stores writes there what is known to be stored


def whole(text):
    """The version of a learned file, if it is what its first line says (docs/storage.md)."""
    head, _, body = text.partition(b"\n")
    found = re.fullmatch(rb"# supercoil learned, format 1, (\d+) bytes, CRC-32 ([0-9a-f]{8})", head)
    if not found or len(body) != int(found[1]) or zlib.crc32(body) != int(found[2], 16):
        return None
    return int(re.search(rb"^version = (\d+)$", body, re.M)[1])


def learned(disk):
    """(current, previous) versions after the check that a start makes; None: not there, or damaged."""
    checked = subprocess.run(["/sbin/e2fsck", "-p", disk], capture_output=True, text=True)
    if checked.returncode > 1:
        return None, None, f"e2fsck ended with {checked.returncode}: {checked.stdout.strip()}"
    texts = [subprocess.run(["/sbin/debugfs", "-R", f"cat /learned-1.toml{suffix}", disk], capture_output=True).stdout
             for suffix in ("", ".previous")]
    return whole(texts[0]), whole(texts[1]), ""


def promised(writes, cut):
    """The newest version that was known to be stored before the cut."""
    marks = [int(write.data[7:15]) for write in writes[:cut] if write.offset == MARK_OFFSET and write.data[:7] == b"stored "]
    return max(marks, default=0)


def cut_power(before, start, writes, cut, chance, disk):
    subprocess.run(["cp", "--sparse=always", before, disk], check=True)
    with open(disk, "r+b") as file:
        for offset, data in write_log.left_by_cut(writes, cut, chance):
            if offset >= start:
                file.seek(offset - start)
                file.write(data)
    return learned(disk)


def record(stores):
    """The data partition before, where it began on the card, and all that was written after."""
    card = image.prepared("power_cut_test")
    image.put_board(card, image_test.board_toml())
    start, before = image.offsets(card)[2], rig.BUILD / "power_cut_before.ext4"
    subprocess.run(["dd", f"if={card}", f"of={before}", "bs=1M", f"skip={start >> 20}", "conv=sparse", "status=none"], check=True)
    log = rig.BUILD / "power_cut.log"
    log.write_bytes(b"")
    settings = rig.Settings(share=rig.BUILD / "power_cut_test", watchdog=True, can=True, image=card, write_log=log, time_out_s=6000.0)
    run = image.run("stores", (stores,), settings)
    if run.status != 0:
        sys.exit(f"{run.console}\npower_cut_test: the board did not do its part: {run.status}")
    return before, start, write_log.read(log)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--stores", type=int, default=50)
    parser.add_argument("--cuts", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    wish = parser.parse_args()
    before, start, writes = record(wish.stores)
    chance, lost, disk = random.Random(wish.seed), 0, rig.BUILD / "power_cut.ext4"
    # From the first version on that was stored.
    first = next(i for i, write in enumerate(writes) if write.offset == MARK_OFFSET)
    for number in range(1, wish.cuts + 1):
        cut = chance.randrange(first + 1, len(writes) + 1)
        known = promised(writes, cut)
        current, previous, trouble = cut_power(before, start, writes, cut, chance, disk)
        newest = current or previous or 0
        right = known <= newest <= known + 1 and not trouble
        lost += not right
        print(f"{'ok   ' if right else 'WRONG'} cut {number:4}: before write {cut:6} of {len(writes)}, version {known} was stored: "
              f"found {current}, before it {previous} {trouble}", flush=True)
    print(f"{wish.cuts} power cuts, {lost} lost something")
    sys.exit(1 if lost else 0)


if __name__ == "__main__":
    main()
