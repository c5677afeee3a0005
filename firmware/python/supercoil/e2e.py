"""AUTOSAR E2E Profile 2, which protects commands and their answers."""

_POLYNOMIAL = 0x2F  # CRC-8H2F
COUNTERS = 16


def _step(crc: int) -> int:
    for _ in range(8):
        crc = (crc << 1 ^ _POLYNOMIAL if crc & 0x80 else crc << 1) & 0xFF
    return crc


_TABLE = bytes(_step(byte) for byte in range(256))


def checksum(identifier: int, data: bytes, session: int | None = None) -> int:
    """Over all bytes after the first, the identifier's low byte, and the session if the frame does not carry it."""
    tail = b"" if session is None else session.to_bytes(2, "little")
    crc = 0xFF
    for byte in data[1:] + bytes([identifier & 0xFF]) + tail:
        crc = _TABLE[crc ^ byte]
    return crc ^ 0xFF


def protected(identifier: int, data: bytes, session: int | None = None) -> bytes:
    """The frame's data with its checksum in the first byte."""
    return bytes([checksum(identifier, data, session)]) + data[1:]


def is_intact(identifier: int, data: bytes) -> bool:
    return len(data) > 0 and data[0] == checksum(identifier, data)
