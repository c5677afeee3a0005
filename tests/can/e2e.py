"""AUTOSAR E2E Profile 2, as docs/can.md describes it, independently of the firmware's code."""

CRC_POLYNOMIAL = 0x2F


def crc8(data):
    crc = 0xFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ CRC_POLYNOMIAL if crc & 0x80 else crc << 1) & 0xFF
    return crc ^ 0xFF


def protected(identifier, frame):
    """The frame with its checksum in the first byte."""
    return bytes([crc8(frame[1:] + bytes([identifier & 0xFF]))]) + frame[1:]
