"""load() reads what a simulation and a flight recorder write, as the project's own program does."""

import csv
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy
import pandas

import supercoil

# One fault, so that there is a recording.
SCENARIO = "simulation.duration_s = 4.0\n[[event]]\nat_s = 3.0\ninjected_fault.heater_open = true\n"


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.path = pathlib.Path(folder.name)
        (cls.path / "s.toml").write_text(SCENARIO)
        subprocess.run([os.environ["SUPERCOIL_SIM"], "run", "s.toml", "--out", ".", "--every", "10", "--no-plot",
                        "--allow-fault", "--quiet"], cwd=cls.path, check=True, timeout=300)

    def log(self, *arguments):
        subprocess.run([os.environ["SUPERCOIL"], "log", *arguments, "--out", "out.csv"], cwd=self.path, check=True,
                       capture_output=True, timeout=300)
        with open(self.path / "out.csv") as file:
            return list(csv.DictReader(file))

    def assert_same(self, value, text, where):
        if isinstance(value, str):
            self.assertEqual(value, text, where)
        elif text == "":
            self.assertTrue(numpy.isnan(value), where)
        else:
            numpy.testing.assert_allclose(float(value), float(text), rtol=1e-6, atol=1e-9, err_msg=where)

    def test_a_can_log_matches_supercoil_log(self):
        table = supercoil.load(self.path / "can.log")
        self.assertEqual((table.attrs["node"], table.attrs["damaged_lines"]), (1, 0))
        self.assertEqual(table.attrs["units"]["Power.applied_W"], "W")
        for message in ("Measurement", "Power", "Status", "Estimate", "Emergency"):
            rows = self.log("can.log", "--message", message)
            columns = [column for column in table if column.startswith(f"{message}.")]
            loaded = table[columns].dropna(how="all")
            self.assertEqual(len(loaded), len(rows), message)
            for (time_s, values), row in list(zip(loaded.iterrows(), rows, strict=True))[::7]:
                self.assert_same(time_s, row["time_s"], "time_s")
                for column in columns:
                    self.assert_same(values[column], row[column.partition(".")[2]], column)

    def test_a_can_log_that_starts_at_0_has_the_same_times(self):
        text = (self.path / "can.log").read_text()
        self.assertTrue(text.startswith("(1000000000."))
        (self.path / "old.log").write_text(text.replace("(1", "(0"))
        pandas.testing.assert_frame_equal(supercoil.load(self.path / "old.log"), supercoil.load(self.path / "can.log"))
        (self.path / "board.log").write_text(text.replace("(10", "(17"))
        self.assertGreater(supercoil.load(self.path / "board.log").index[0], 1.7e9)

    def test_a_damaged_first_line_is_left_out_like_any_other(self):
        text = (self.path / "can.log").read_text()
        rest = text[text.index("\n") + 1:]
        (self.path / "rest.log").write_text(rest)
        whole = supercoil.load(self.path / "rest.log")
        for first in (text[8:text.index("\n")], "# recorded on the bench", ""):
            (self.path / "cut.log").write_text(f"{first}\n{rest}")
            table = supercoil.load(self.path / "cut.log")
            pandas.testing.assert_frame_equal(table, whole)
            self.assertEqual(table.attrs["damaged_lines"], 0 if first == "" else 1)

    def test_a_log_of_two_nodes_requires_a_node(self):
        text = (self.path / "can.log").read_text()
        (self.path / "two.log").write_text(text + "nonsense\n" + text.replace("701#", "702#"))
        with self.assertRaisesRegex(ValueError, "nodes 1, 2"):
            supercoil.load(self.path / "two.log")
        table = supercoil.load(self.path / "two.log", node=2)
        self.assertEqual({column.partition(".")[0] for column in table}, {"Status"})
        self.assertEqual(table.attrs["damaged_lines"], 1)

    def test_a_recording_matches_supercoil_log(self):
        table = supercoil.load(self.path / "flight-1.scfr")
        rows = self.log("flight-1.scfr")
        self.assertEqual(len(table), len(rows))
        self.assertEqual(table.attrs["fault"], "heater_open")
        self.assertEqual(table.attrs["units"]["applied_W"], "W")
        others = {"probing", "trusted", "limited"}  # flags as numbers
        for place in range(0, len(rows), 371):
            self.assert_same(table.index[place], rows[place]["time_s"], "time_s")
            for column, text in rows[place].items():
                if column not in others | {"time_s"}:
                    self.assert_same(table[column].iloc[place], text, column)

    def test_a_damaged_recording_is_refused(self):
        whole = (self.path / "flight-1.scfr").read_bytes()
        for place, said in ((100, "header is damaged"), (600, "rows are damaged")):
            damaged = bytearray(whole)
            damaged[place] ^= 1
            (self.path / "damaged.scfr").write_bytes(damaged)
            with self.assertRaisesRegex(ValueError, said):
                supercoil.load(self.path / "damaged.scfr")

    def test_what_is_missing_of_a_truncated_file_is_named(self):
        flight, trace = ((self.path / name).read_bytes() for name in ("flight-1.scfr", "trace.csv"))
        columns = trace.split(b"\n")[0].count(b",") + 1
        for content, said in ((b"", "cut: is empty"),
                              (flight[:300], "cut: is cut off after 300 of the 512 bytes of its header"),
                              (flight[:512 + 3 * 112 + 50], "cut: is cut off after 3 of [0-9]+ rows; supercoil log"),
                              (trace[:trace.rindex(b",", 0, -60)], f"cut:401: has [0-9]+ fields; there are {columns}"),
                              (trace + b"1" + b"," * columns, f"cut: is not a table: .*Expected {columns} fields")):
            (self.path / "cut").write_bytes(content)
            with self.assertRaisesRegex(ValueError, said):
                supercoil.load(self.path / "cut")

    def test_a_trace_has_its_rows_and_units(self):
        table = supercoil.load(self.path / "trace.csv")
        self.assertEqual(len(table), 400)
        units = table.attrs["units"]
        self.assertEqual((units["measured_m"], units["temperature_rise_K"], units["theta4"], units["thermometer_C"],
                          units["state"]), ("m", "K", "W/m", "degC", ""))

    def test_a_joint_trace_has_angles_by_its_lever(self):
        (self.path / "joint.toml").write_text(
            "simulation.duration_s = 3.0\nreference.kind = 'step'\n"
            "[joint]\nlever_m = [0.012, 0.015, 0.011]\nlever_range_deg = [-30.0, 30.0]\n")
        subprocess.run([os.environ["SUPERCOIL_SIM"], "run", "joint.toml", "--out", "joint", "--every", "20",
                        "--no-plot", "--no-can", "--allow-fault", "--quiet"], cwd=self.path, check=True, timeout=300)
        table = supercoil.load(self.path / "joint" / "trace.csv")
        lever = supercoil.LeverTable(-30.0, 30.0, (0.012, 0.015, 0.011))
        for angle, position in (("joint_angle_deg", "position_m"), ("joint_reference_deg", "model_m")):
            for angle_deg, position_m in zip(table[angle], table[position], strict=True):
                self.assertAlmostEqual(angle_deg, math.degrees(lever.angle_rad(position_m)), 9)
            self.assertGreater(table[angle].max(), 1.0)
            self.assertEqual(table.attrs["units"][angle], "deg")
        self.assertNotIn("joint_angle_deg", supercoil.load(self.path / "trace.csv").columns)

    def test_a_numpy_trace_has_the_same_rows(self):
        for options in ([], ["--npy"]):  # an earlier run's is not left beside it
            subprocess.run([os.environ["SUPERCOIL_SIM"], "run", "s.toml", "--out", "npy", "--every", "10", "--no-plot",
                            "--no-can", "--allow-fault", "--quiet", *options], cwd=self.path, check=True, timeout=300)
        self.assertFalse((self.path / "npy" / "trace.csv").exists())
        table, same = supercoil.load(self.path / "npy" / "trace.npy"), supercoil.load(self.path / "trace.csv")
        pandas.testing.assert_frame_equal(table, same, check_exact=True, check_dtype=False)
        self.assertEqual(table["fault"].iloc[-1], "heater_open")

    def test_other_files_are_refused(self):
        numpy.save(self.path / "other.npy", numpy.zeros(3))
        with self.assertRaisesRegex(ValueError, "is not a trace"):
            supercoil.load(self.path / "other.npy")
        whole = (self.path / "other.npy").read_bytes()
        for length in (7, 60, len(whole) - 1):
            (self.path / "damaged.npy").write_bytes(whole[:length])
            with self.assertRaisesRegex(ValueError, "damaged.npy: "):
                supercoil.load(self.path / "damaged.npy")
        with self.assertRaisesRegex(ValueError, "is not a can.log"):
            supercoil.load(self.path / "s.toml")

    def test_each_kind_of_file_can_be_plotted(self):
        for name in ("can.log", "flight-1.scfr", "trace.csv"):
            figure = supercoil.plot(supercoil.load(self.path / name), self.path / "figure.svg")
            self.assertTrue(all(panel.lines for panel in figure.axes[:2]), name)
            self.assertTrue((self.path / "figure.svg").read_text().startswith("<?xml"))


if __name__ == "__main__":
    unittest.main()
