"""Writes the seeds that are not text: .venv/bin/python tests/fuzz/seeds.py [--check]

--check: only compares the seeds in the tree with those that it would write.

Boards and scenarios are links in corpus/ to the project's own examples; commands are kept as text files. The whole
firmware (fuzz_can_endpoint) uses the seeds of fuzz_frames.
"""

import pathlib
import struct
import sys
import zlib

import cantools

CORPUS = pathlib.Path(__file__).parent / "corpus"
# Bits of Step::how (steps.hpp).
TO_CHANNEL, WITH_SESSION, WITH_COUNTER, SEALED, WHOLE, WITH_NONCE, KNOT, PLAY = 1, 2, 4, 8, 16, 32, 64, 128
HOLDER = TO_CHANNEL | WITH_SESSION | WITH_COUNTER | SEALED | WHOLE
STRANGER = TO_CHANNEL | SEALED | WHOLE
DBC = cantools.database.load_file(pathlib.Path(__file__).parents[2] / "firmware/io/can/supercoil.dbc")
OPCODE = {str(name): number for number, name in
          DBC.get_message_by_name("Command").get_signal_by_name("opcode").choices.items()}


def step(how, opcode, value=0.0, wait=2, channel=0, session=0x1234, counter=0):
    return struct.pack("<BBHBBHf", how, wait, channel, 0, OPCODE.get(opcode, opcode) << 4 | counter, session, value)


def knot(after_s, position_m, velocity=0.0, wait=2):
    """A step with a knot, which has no session in its data."""
    return struct.pack("<BBHBBH", HOLDER & ~WITH_SESSION | KNOT, wait, 0, 0, round(after_s * 1e3) << 4 & 0xF0,
                       round(after_s * 1e3) >> 4 | round(position_m * 1e7) << 8 & 0xFF00) + struct.pack(
        "<Hh", round(position_m * 1e7) >> 8, round(velocity * 1e5))


def play(when, after_s, wait=2):
    return struct.pack("<BBHBBHBBH", HOLDER | PLAY, wait, 0, 0, when << 4, 0, 0, round(after_s * 1e5) & 0xFF,
                       round(after_s * 1e5) >> 8)


CLAIMED = step(STRANGER, "lease") + step(STRANGER | WITH_NONCE, "lease")
ARMED = CLAIMED + step(HOLDER, "arm", wait=20)
FRAMES = {
    "arms_moves_rests_releases": ARMED + step(HOLDER, "position", 0.01, 10) + step(HOLDER, "renew", wait=10)
    + step(HOLDER, "rest") + step(HOLDER, "lease", -1.0),
    "falls_silent": ARMED + step(HOLDER, "power", 2.0, 200) + step(HOLDER, "renew") + CLAIMED + step(HOLDER, "reset"),
    "is_stopped_by_a_stranger": ARMED + step(HOLDER, "position", 0.01, 10) + step(STRANGER, "disarm"),
    "a_stranger_is_refused": ARMED + step(STRANGER, "position", 0.01) + step(STRANGER, "lease"),
    "a_recorded_session_is_refused": step(STRANGER, "lease") + step(STRANGER, "lease", 0x1234)
    + step(STRANGER, "arm", session=0x5678),
    "claims_as_in_version_3": step(STRANGER, 14) + step(STRANGER, "disarm"),
    "is_damaged": ARMED + 12 * step(HOLDER & ~SEALED, "renew") + step(HOLDER, "reset"),
    "repeats_itself": ARMED + 3 * step(HOLDER & ~WITH_COUNTER, "renew"),
    "counts_on_from_a_claim_that_means_nothing": CLAIMED
    + step(HOLDER & ~WITH_COUNTER, "lease", 1.0, counter=5) + step(HOLDER & ~WITH_COUNTER, "arm", counter=1),
    "learns": ARMED + step(HOLDER, "calibrate") + step(HOLDER, "identify", wait=9) + step(HOLDER, "scale", 0.01)
    + step(HOLDER, "controller", 2.0) + step(HOLDER, "estimator", 0.0),
    "compares_three_senses": CLAIMED + step(HOLDER, "compare", 12.0) + step(HOLDER, "compare", -1.5)
    + step(HOLDER, "compare", 1023.5),
    "tunes": ARMED + step(HOLDER, "controller", 1001.0) + step(HOLDER, "store", 2.0) + step(HOLDER, "store", 3.0),
    "plays_a_trajectory": ARMED + step(HOLDER, "position", 0.001, 40) + knot(0.0, 0.001) + knot(1.0, 0.0011, 0.0001)
    + knot(1.0, 0.0012) + play(0, 0.02, 80) + play(2, 0.0) + step(HOLDER, "rest") + play(0, 0.02),
    "runs_dry": ARMED + step(HOLDER, "position", 0.001, 40) + knot(0.0, 0.001) + knot(0.2, 0.00102, 0.0001)
    + play(0, 0.02, 20) + 8 * step(HOLDER, "renew", wait=20),
    "the_other_channel": step(STRANGER, "lease", channel=1)
    + step(STRANGER | WITH_NONCE, "lease", channel=1) + step(HOLDER, "arm", wait=20, channel=1)
    + step(HOLDER, "power", 1.0, channel=1) + step(0, "lease"),
}


def row(time_ns, state=2, fault=0):
    return struct.pack("<q8B24f", time_ns, 0, state, 2, fault, 0, 0, 2, 9, *[float("nan"), 0.01, 4.0] * 8)


def recording(rows, said):
    """said: the number of rows in its header."""
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


TUNED = """\
version = 2

[controller_1]
kind = 1.0
integral_W_per_m_s = 900.0

[chosen]
controller = 1.0
"""

STORED_SETS = {"body": STORED.encode(), "whole": envelope(STORED), "cut_off": envelope(STORED)[:-20],
               "tuned": TUNED.encode()}


def main():
    only_check = sys.argv[1:] == ["--check"]
    for target, seeds in {"fuzz_frames": FRAMES, "fuzz_recording": RECORDINGS,
                          "fuzz_stored_set": STORED_SETS}.items():
        for name, content in seeds.items():
            file = CORPUS / target / name
            if not only_check:
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(content)
            elif not file.exists() or file.read_bytes() != content:
                sys.exit(f"{file} is not what {__file__} writes: run it again")


if __name__ == "__main__":
    main()
