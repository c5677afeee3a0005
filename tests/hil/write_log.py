"""What QEMU's blklogwrites recorded of a board's disk: every write in order, and what a power cut leaves of them.

The format is that of the kernel's dm-log-writes (Documentation/admin-guide/device-mapper/log-writes.rst).
"""

import dataclasses
import struct

SECTOR = 512
MAGIC = 0x6A736677736872
FLUSH, FUA, DISCARD = 1, 2, 4


@dataclasses.dataclass
class Write:
    offset: int  # bytes from the disk's beginning
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
        # The count is only written now and then; a header of zeros ends a log that was cut.
        while len(header := file.read(size)) == size:
            sector, sectors, flags, _ = struct.unpack_from("<QQQQ", header)
            if sectors == 0 and flags == 0:
                break
            data = b"" if flags & DISCARD else file.read(sectors * size)
            if not flags & DISCARD:
                writes.append(Write(sector * size, flags, data))
    return writes


def left_by_cut(writes, cut, chance):
    """The writes on the disk when the power goes off before writes[cut], as (offset, data), and how many are lost.

    All before the last flush are there; any of the later ones may be, as the disk's cache has written them or not; and
    perhaps a part of the next, sector by sector.
    """
    safe = max((place for place in range(cut) if writes[place].flags & FLUSH), default=0)
    unsafe = writes[safe:cut]
    kept = [write for write in unsafe if write.flags & FUA or chance.random() < 0.5]
    torn = writes[cut]
    sectors = [at for at in range(0, len(torn.data), SECTOR) if chance.random() < 0.5]
    left = [(write.offset, write.data) for write in [*writes[:safe], *kept]]
    left += [(torn.offset + at, torn.data[at:at + SECTOR]) for at in sectors]
    return left, sum(bool(write.data) for write in unsafe) - sum(bool(write.data) for write in kept)
