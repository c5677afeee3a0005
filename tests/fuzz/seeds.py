"""Writes the seeds that are no text: python3 tests/fuzz/seeds.py

Boards and scenarios are the project's own examples, by links in corpus/; commands are there as they are. The whole
firmware (fuzz_can_link) has the seeds of fuzz_frames.
"""

import pathlib
import struct
import zlib

CORPUS = pathlib.Path(__file__).parent / "corpus"
# Bits of Step::how (steps.hpp).
TO_CHANNEL, WITH_SESSION, WITH_COUNTER, SEALED, WHOLE = 1, 2, 4, 8, 16
HOLDER = TO_CHANNEL | WITH_SESSION | WITH_COUNTER | SEALED | WHOLE
STRANGER = TO_CHANNEL | SEALED | WHOLE
NONE, ARM, DISARM, RESET, POSITION, POWER, RENEW, REST, IDENTIFY, CALIBRATE, SCALE, CONTROLLER, ESTIMATOR = range(13)
CLAIM, RELEASE = 13, 14


def step(how, verb, value=0.0, wait=2, channel=0, session=0x1234):
    return struct.pack("<BBH", how, wait, channel) + struct.pack("<BBHf", 0, verb << 4, session, value)


CLAIMED = step(STRANGER, CLAIM)
ARMED = CLAIMED + step(HOLDER, ARM, wait=20)
FRAMES = {
    "arms_moves_rests_releases": ARMED + step(HOLDER, POSITION, 0.01, 10) + step(HOLDER, RENEW, wait=10)
    + step(HOLDER, REST) + step(HOLDER, RELEASE),
    "falls_silent": ARMED + step(HOLDER, POWER, 2.0, 200) + step(HOLDER, RENEW) + CLAIMED + step(HOLDER, RESET),
    "is_stopped_by_a_stranger": ARMED + step(HOLDER, POSITION, 0.01, 10) + step(STRANGER, DISARM),
    "a_stranger_is_refused": ARMED + step(STRANGER, POSITION, 0.01) + step(STRANGER, CLAIM),
    "is_damaged": ARMED + 12 * step(HOLDER & ~SEALED, RENEW) + step(HOLDER, RESET),
    "repeats_itself": ARMED + 3 * step(HOLDER & ~WITH_COUNTER, RENEW),
    "learns": ARMED + step(HOLDER, CALIBRATE) + step(HOLDER, IDENTIFY, wait=9) + step(HOLDER, SCALE, 0.01)
    + step(HOLDER, CONTROLLER, 2.0) + step(HOLDER, ESTIMATOR, 0.0),
    "the_other_channel": step(STRANGER, CLAIM, channel=1) + step(HOLDER, ARM, wait=20, channel=1)
    + step(HOLDER, POWER, 1.0, channel=1) + step(0, NONE),
}


def row(time_ns, state=2, fault=0):
    return struct.pack("<q8B24f", time_ns, 0, state, 2, fault, 0, 0, 2, 9, *[float("nan"), 0.01, 4.0] * 8)


def recording(rows, said):
    """said: how many rows its header speaks of."""
    rest = (f'# Rows follow at byte 512. To read them: supercoil log FILE\nrow_bytes = 112\nrows = {said}\nchannels = 1\n'
            f'rate_Hz = 1000\nfault = 23\nfault_name = "sensor_stale"\nfault_channel = 1\nfault_time_ns = 2000000\n'
            f'rows_CRC32 = "{zlib.crc32(rows):08x}"\n')
    first = "supercoil flight recording, format 1, CRC-32 {:08x}\n"
    rest = rest.ljust(512 - len(first.format(0)) - 1).encode() + b"\n"
    return first.format(zlib.crc32(rest)).encode() + rest + rows


ROWS = row(1_000_000) + row(2_000_000, 3, 23)
RECORDINGS = {
    "rows": ROWS,
    "whole": recording(ROWS, 2),
    "cut_off": recording(ROWS[:150], 2),
    "damaged_header": recording(ROWS, 2).replace(b"rate_Hz", b"rate_hz"),
}

STORED = """\
version = 1

[muscle]
thermal_mass_J_per_K = 0.162
heat_transfer_W_per_K = 0.089
stiffness_N_per_m = 16.0
damping_Ns_per_m = 2.0
moving_mass_kg = 0.09
force_per_kelvin_N_per_K = 0.0086

[calibration]
position_offset_m = 0.0
position_scale = 1.0
cold_resistance_Ohm = 10.0
"""


def envelope(body):
    line = f"# supercoil learned, format 1, {len(body)} bytes, CRC-32 {zlib.crc32(body.encode()):08x}\n"
    return (line + body).encode()


STORED_SETS = {"body": STORED.encode(), "whole": envelope(STORED), "cut_off": envelope(STORED)[:-20]}

if __name__ == "__main__":
    for target, seeds in {"fuzz_frames": FRAMES, "fuzz_recording": RECORDINGS,
                          "fuzz_stored_set": STORED_SETS}.items():
        folder = CORPUS / target
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in seeds.items():
            (folder / name).write_bytes(content)
