"""What QEMU's blklogwrites recorded of a board's card: every write in its order, and what a power cut leaves of them.

The format is that of the kernel's dm-log-writes (Documentation/admin-guide/device-mapper/log-writes.rst).
"""

import dataclasses
import struct

SECTOR = 512
MAGIC = 0x6A736677736872
FLUSH, FUA, DISCARD = 1, 2, 4


@dataclasses.dataclass
class Write:
    offset: int  # bytes from the card's beginning
    flags: int
    data: bytes


def read(path):
    """All writes; a flush without data is one of 0 bytes. Discards promise nothing, and are left out."""
    writes = []
    with open(path, "rb") as file:
        magic, version, count, size = struct.unpack("<QQQI", file.read(28))
        if magic != MAGIC or version != 1:
            raise ValueError(f"{path}: is no log of writes")
        file.seek(size)
        # The count is written now and then only; a header of zeros ends a log that was cut.
        while len(header := file.read(size)) == size:
            sector, sectors, flags, _ = struct.unpack_from("<QQQQ", header)
            if sectors == 0 and flags == 0:
                break
            data = b"" if flags & DISCARD else file.read(sectors * size)
            if not flags & DISCARD:
                writes.append(Write(sector * size, flags, data))
    return writes


def left_by_cut(writes, cut, random):
    """Writes that are on the disk when the power goes off before writes[cut]: all before the last flush, and of the later
    ones, which the disk's cache may have written or not, any; the last of them perhaps torn, sector by sector."""
    safe = max((i for i in range(cut) if writes[i].flags & FLUSH), default=0)
    for write in writes[:safe]:
        yield write.offset, write.data
    for write in writes[safe:cut]:
        if write.flags & FUA or random.random() < 0.5:
            yield write.offset, write.data
    if cut < len(writes):
        torn = writes[cut]
        for at in range(0, len(torn.data), SECTOR):
            if random.random() < 0.5:
                yield torn.offset + at, torn.data[at:at + SECTOR]
