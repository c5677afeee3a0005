"""Every fault and refusal that the protocol has a name for has its exception, with its page's text."""

import os
import pathlib
import pickle
import re
import socket
import subprocess
import unittest
from unittest import mock

import can
from can.interfaces.socketcand import socketcand

import supercoil
from supercoil import address
from supercoil.generated import faults, names, refusals, results, tunables

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Errors(unittest.TestCase):
    def test_every_fault_has_an_error_with_its_page(self):
        self.assertEqual(set(faults.BY_NUMBER), set(names.Fault) - {names.Fault.none})
        for number, kind in faults.BY_NUMBER.items():
            name = names.Fault(number).name
            self.assertEqual((kind.number, kind.name, kind.__name__), (number, name, name.title().replace("_", "")))
            self.assertEqual(kind.page, (ROOT / "docs" / "faults" / f"{name}.md").read_text())
            self.assertTrue(issubclass(kind, supercoil.FaultError))
            self.assertTrue(kind.meaning and kind.remedy, name)

    def test_a_fault_names_the_measured_value_and_the_remedy(self):
        text = str(faults.OverTemperature(3, 161.0, 160.0))
        self.assertTrue(text.startswith("node 3: over_temperature (measured 161, limit 160): "), text)
        self.assertIn("otherwise let the muscle cool", text.lower())
        self.assertTrue(str(faults.OverTemperature(3)).startswith("node 3: over_temperature: "))

    def test_every_refusal_has_an_error(self):
        self.assertEqual(set(refusals.BY_NUMBER), set(names.Refusal) - {names.Refusal.none})
        for number, kind in refusals.BY_NUMBER.items():
            self.assertEqual((kind.number, kind.name), (number, names.Refusal(number).name))
            self.assertTrue(kind.meaning)
        self.assertIn("0.025 would be obeyed", str(refusals.OutOfRange(1, "position", 0.025)))

    def test_an_error_survives_the_way_to_another_process(self):
        for error in (faults.OverTemperature(3, 161.0, 160.0), refusals.OutOfRange(1, "position", 0.025),
                      supercoil.VersionMismatchError(7, 4), supercoil.NoAnswerError("no answer"),
                      supercoil.OutcomeError("identify ended: poor_fit", "poor_fit", ("friction",))):
            with self.subTest(type(error).__name__):
                restored = pickle.loads(pickle.dumps(error))
                self.assertIs(type(restored), type(error))
                self.assertEqual((str(restored), str(vars(restored))), (str(error), str(vars(error))))

    def test_units_and_choices_match_the_board(self):
        def range_text(name, *options):
            return subprocess.run([os.environ["SUPERCOIL"], "tune", "1", f"{name}=*", "--socket", "/nowhere", *options],
                                  capture_output=True, text=True).stderr

        for units, choices, options in (
                (tunables.CONTROLLER_UNITS, tunables.CONTROLLER_CHOICES, ()),
                (tunables.ESTIMATOR_UNITS, tunables.ESTIMATOR_CHOICES, ("--estimator", "0"))):
            self.assertIn(f"there are: {', '.join(map(str, units))}\n", range_text("all", *options))
            for tunable in units:
                with self.subTest(tunable, options=options):
                    if tunable in choices:
                        self.assertIn(f"there are: {', '.join(choices[tunable])}\n", range_text(tunable, *options))
                        continue
                    lowest, highest = re.search(r"must be (\S+) to (\S+)\n", range_text(tunable, *options)).groups()
                    self.assertEqual((float(lowest), float(highest)), tunables.RANGES[tunable])

    def test_every_result_has_a_meaning(self):
        self.assertEqual(set(results.MEANINGS), set(names.Result))
        self.assertEqual(len(results.NOTES), 8)

    def test_a_version_mismatch_names_both_and_the_remedy(self):
        for of_board, older in ((supercoil.PROTOCOL_VERSION + 1, "this package"), (3, "the board's firmware")):
            text = str(supercoil.VersionMismatchError(7, of_board))
            self.assertIn(f"node 7 speaks version {of_board} ", text)
            self.assertIn(f"speaks {supercoil.PROTOCOL_VERSION}: {older}", text)
            self.assertIn("Install", text)


class PythonCan(unittest.TestCase):
    def test_socketcand_needs_4_4_even_without_a_version(self):
        for version, reliable in (("4.1.0", False), ("4.3.1", False), ("4.4.0", True), ("4.10.0", True), ("5.0", True),
                                  ("0.0.0", True)):
            with mock.patch.object(can, "__version__", version):
                self.assertEqual(address._is_reliable(), reliable, version)
        with mock.patch.object(can, "__version__", "0.0.0"), mock.patch.object(socketcand, "detect_beacon"):
            del socketcand.detect_beacon
            self.assertFalse(address._is_reliable())
            with self.assertRaisesRegex(supercoil.BusError, "needs python-can 4.4"):
                address.open_bus("socketcand:1", {})

    def test_a_silent_server_times_out(self):
        with socket.create_server(("127.0.0.1", 0)) as server, mock.patch.object(address, "_GREETED_WITHIN_S", 0.01), \
                self.assertRaisesRegex(supercoil.BusError, "timed out"):
            address.open_bus(f"socketcand:{server.getsockname()[1]}", {})


if __name__ == "__main__":
    unittest.main()
