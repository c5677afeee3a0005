"""The package's codec and arrays read and write every message as cantools does; its checksum is the protocol's."""

import math
import pathlib
import random
import sys
import unittest

import cantools

from supercoil import codec, e2e
from supercoil.arrays import decode_all
from supercoil.generated import names
from supercoil.layout import Raw

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "can"))
import e2e as reference  # noqa: E402

DATABASE = cantools.database.load_file(ROOT / "firmware" / "io" / "can" / "supercoil.dbc")
FRAMES = 200


def expected(message, data):
    """Signal -> value, by cantools; NaN: not available, or not in this frame."""
    decoded = message.decode(data, decode_choices=True)
    plain = message.decode(data, decode_choices=False)
    return {signal.name: math.nan if signal.name not in decoded or str(decoded[signal.name]) == "not_available"
            else plain[signal.name] for signal in message.signals}


def random_frames(message, chance):
    for _ in range(FRAMES):
        data = bytearray(chance.randbytes(message.length))
        if message.is_multiplexed():
            selector = message.signals[0]
            mask = (1 << selector.length) - 1
            data[0] = data[0] & ~mask & 0xFF | chance.choice(list(selector.choices))
        yield bytes(data)
    # All ones and the sign alone: not available.
    if not message.is_multiplexed():
        yield b"\xff" * message.length
        for signal in message.signals:
            yield (1 << signal.start + signal.length - 1).to_bytes(message.length, "little")


class Codec(unittest.TestCase):
    def setUp(self):
        self.chance = random.Random(20261124)

    def assert_same(self, value, wanted, where):
        if math.isnan(wanted):
            self.assertTrue(math.isnan(value), where)
        else:
            self.assertTrue(math.isclose(value, wanted, rel_tol=1e-12, abs_tol=1e-15), f"{where}: {value}, {wanted}")

    def test_every_message_of_the_dbc_is_known(self):
        ours = {layout.name: (layout.base, layout.length, layout.cycle_ms) for layout in codec.LAYOUTS.values()}
        self.assertEqual({message.name: (message.frame_id - 1, message.length, message.cycle_time or 0)
                          for message in DATABASE.messages}, ours)

    def test_decodes_like_cantools(self):
        for message in DATABASE.messages:
            for data in random_frames(message, self.chance):
                decoded = codec.decode(message.frame_id - 1, data, 1.5)
                self.assertEqual(decoded.time_s, 1.5)
                for name, value in expected(message, data).items():
                    self.assert_same(getattr(decoded, name), value, f"{message.name}.{name}")

    def test_arrays_match_single_frames(self):
        for message in DATABASE.messages:
            frames = [(float(i), data) for i, data in enumerate(random_frames(message, self.chance))]
            arrays = decode_all(message.frame_id - 1, frames)
            for i, (time_s, data) in enumerate(frames):
                decoded = codec.decode(message.frame_id - 1, data, time_s)
                for name, value in decoded._asdict().items():
                    self.assert_same(arrays[name][i], value, f"{message.name}.{name}")

    def test_encoding_inverts_decoding(self):
        for message in DATABASE.messages:
            layout = codec.LAYOUTS[message.frame_id - 1]
            for data in random_frames(message, self.chance):
                decoded = codec.decode(layout.base, data)
                values = decoded._asdict()
                values.pop("time_s")
                if message.is_multiplexed():
                    values = {name: value for name, value in values.items() if not math.isnan(value)}
                again = codec.decode(layout.base, codec.encode(layout, values))
                for name, value in values.items():
                    self.assert_same(getattr(again, name), value, f"{message.name}.{name}")

    def test_a_value_beyond_its_range_is_clipped(self):
        layout = codec.BY_NAME["Measurement"]
        for sent, expected_m in ((5.0, 0.8388607), (-5.0, -0.8388607), (math.nan, math.nan)):
            decoded = codec.decode(layout.base, codec.encode(layout, {"position_m": sent}))
            self.assert_same(decoded.position_m, expected_m, sent)

    def test_frames_of_wrong_length_or_identifier_are_ignored(self):
        self.assertIsNone(codec.decode(0x280, bytes(7)))
        self.assertIsNone(codec.decode(0x7C0, bytes(8)))

    def test_an_unnamed_value_keeps_its_number(self):
        fault = codec.decode(0x700, bytes([0, 99, 0, 0, 0, 0, 4, 0])).fault
        self.assertEqual((fault, str(fault)), (99, "unknown_99"))
        self.assertIs(codec.decode(0x700, bytes([3, 60, 0, 0, 0, 0, 4, 0])).fault, names.Fault.command_timeout)

    def test_scales_divide_one(self):
        # Signal.steps divides by them.
        for layout in codec.LAYOUTS.values():
            for signal in layout.signals:
                if signal.raw is not Raw.floating:
                    self.assertAlmostEqual(signal.steps * signal.scale, 1.0, 12)

    def test_checksum_matches_the_protocol(self):
        for _ in range(1000):
            identifier, data = self.chance.randrange(0x800), self.chance.randbytes(8)
            protected = e2e.protected(identifier, data)
            self.assertEqual(protected, reference.protected(identifier, data))
            self.assertTrue(e2e.is_intact(identifier, protected))
            session = self.chance.randrange(0x10000)
            of_session = reference.crc8(data[1:] + bytes([identifier & 0xFF]) + session.to_bytes(2, "little"))
            self.assertEqual(e2e.protected(identifier, data, session), bytes([of_session]) + data[1:])
            damaged = bytearray(protected)
            for bit in self.chance.sample(range(64), self.chance.randint(1, 3)):
                damaged[bit // 8] ^= 1 << bit % 8
            self.assertFalse(e2e.is_intact(identifier, bytes(damaged)))


if __name__ == "__main__":
    unittest.main()
