"""AUTOSAR E2E Profile 2, by which commands and their answers are protected."""

_POLYNOMIAL = 0x2F  # CRC-8H2F
COUNTERS = 16


def _step(crc: int) -> int:
    for _ in range(8):
        crc = (crc << 1 ^ _POLYNOMIAL if crc & 0x80 else crc << 1) & 0xFF
    return crc


_TABLE = bytes(_step(byte) for byte in range(256))


def checksum(identifier: int, data: bytes) -> int:
    """Over what follows the first byte, and the identifier's low byte."""
    crc = 0xFF
    for byte in data[1:]:
        crc = _TABLE[crc ^ byte]
    return _TABLE[crc ^ identifier & 0xFF] ^ 0xFF


def protected(identifier: int, data: bytes) -> bytes:
    """With its checksum in the first byte."""
    return bytes([checksum(identifier, data)]) + data[1:]


def is_intact(identifier: int, data: bytes) -> bool:
    return len(data) > 0 and data[0] == checksum(identifier, data)
