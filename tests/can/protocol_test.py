"""The DBC is the single source of the CAN protocol: what is generated from it is up to date, its names for numbers are
those of the firmware, and it keeps its own rules."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import cantools

ROOT = pathlib.Path(__file__).resolve().parents[2]
DBC = ROOT / "firmware" / "io" / "can" / "supercoil.dbc"
GENERATED = ["tests/can/generated/supercoil.c", "tests/can/generated/supercoil.h", "docs/can-protocol.md",
             "firmware/io/can/generated/messages.hpp",
             *(f"firmware/python/supercoil/generated/{module}.py" for module in (
                 "__init__", "faults", "messages", "names", "refusals", "results", "tunables", "version"))]
NOT_AVAILABLE = "not_available"


class Protocol(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.database = cantools.database.load_file(DBC)
        cls.names = json.loads(subprocess.run([os.environ["CAN_NAMES"]], capture_output=True, check=True).stdout)

    def signals(self):
        for message in self.database.messages:
            for signal in message.signals:
                yield message, signal, {raw: str(name) for raw, name in (signal.choices or {}).items()}

    def test_generated_files_match_the_committed_ones(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([ROOT / "toolchain" / "generate-can", folder], check=True)
            for name in GENERATED:
                fresh = (pathlib.Path(folder) / name).read_bytes()
                self.assertTrue(fresh == (ROOT / name).read_bytes(), f"{name}: run toolchain/generate-can")

    def test_value_names_match_the_firmware(self):
        seen = set()
        for message, signal, choices in self.signals():
            if signal.name in self.names:
                seen.add(signal.name)
                expected = {int(raw): name for raw, name in self.names[signal.name].items()}
                self.assertEqual(choices, expected, f"{message.name}.{signal.name}")
        self.assertEqual(seen, self.names.keys() - {"version"})
        self.assertEqual(self.database.dbc.attributes["ProtocolVersion"].value, self.names["version"])

    def test_named_values_are_within_the_signals_range(self):
        for message, signal, choices in self.signals():
            named = [raw for raw, name in choices.items() if name != "not_available"]
            if named:
                self.assertLessEqual(signal.minimum, min(named) * signal.scale, f"{message.name}.{signal.name}")
                self.assertGreaterEqual(signal.maximum, max(named) * signal.scale, f"{message.name}.{signal.name}")

    def test_identifiers_are_those_of_node_1(self):
        bases = [message.frame_id - 1 for message in self.database.messages]
        self.assertEqual(len(set(bases)), len(bases))
        for base in bases:
            self.assertEqual(base % 0x40, 0)
            self.assertTrue(0x040 <= base <= 0x780)

    def test_every_message_and_signal_has_a_comment(self):
        for message, signal, _ in self.signals():
            for what in (message, signal):
                self.assertTrue(what.comment and what.comment.endswith("."), f"{message.name}.{what.name}: no comment")

    def test_signal_names_end_with_their_unit(self):
        for _, signal, _ in self.signals():
            unit = {"degC": "C"}.get(signal.unit, signal.unit)
            if unit and not signal.name.startswith("theta"):
                self.assertTrue(signal.name.endswith("_" + unit.replace("/", "_per_")), f"{signal.name}: {unit}")

    def test_a_scaled_signal_reserves_one_value_for_not_available(self):
        for message, signal, choices in self.signals():
            if NOT_AVAILABLE not in choices.values():
                continue
            self.assertEqual(len(choices), 1)
            reserved, = choices
            most = 2 ** (signal.length - 1) - 1 if signal.is_signed else 2 ** signal.length - 2
            self.assertEqual(reserved, -most - 1 if signal.is_signed else most + 1)
            self.assertAlmostEqual(signal.maximum, most * signal.scale, 9)
            self.assertAlmostEqual(signal.minimum, -most * signal.scale if signal.is_signed else 0, 9)

    def test_only_event_messages_have_no_cycle_time(self):
        when_needed = {message.name for message in self.database.messages if not message.cycle_time}
        self.assertEqual(when_needed, {"Emergency", "FirstCause", "Command", "Acknowledge", "RefusedValue", "Setting",
                                       "SettingWrite", "SettingRead", "Muscle", "MuscleRead", "Tuning", "TuningWrite",
                                       "TuningRead", "Sync", "Knot", "Play", "Trajectory"})


if __name__ == "__main__":
    unittest.main()
