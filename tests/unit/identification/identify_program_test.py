"""supercoil identify as seen by a laboratory, on recordings of muscles that supercoil-sim made."""

import csv
import itertools
import json
import math
import os
import pathlib
import subprocess
import tempfile
import tomllib
import unittest

SUPERCOIL = os.environ["SUPERCOIL"]
SUPERCOIL_SIM = os.environ["SUPERCOIL_SIM"]
WRITE_SAMPLE = os.environ["WRITE_SAMPLE"]

# Far from the paper's muscle, where every fit starts.
MUSCLE = {"thermal_mass_J_per_K": 0.25, "heat_transfer_W_per_K": 0.06, "stiffness_N_per_m": 25.0,
          "damping_Ns_per_m": 3.0, "moving_mass_kg": 0.12, "force_per_kelvin_N_per_K": 0.012}
GAIN_M_PER_W = 0.012 / (0.06 * 25.0)
TIME_CONSTANT_S = 0.25 / 0.06
SCENARIO = """
simulation = { duration_s = 100.0, rate_Hz = 100.0 }
power = { max_W = 5.0 }
controller = { kind = "power" }
estimator = { kind = "none" }
[reference]
kind = "power"
offset_W = 0.0
amplitudes_W = [1.5, 1.0]
angular_frequencies_rad_per_s = [0.1, 0.35]
[plant]
"""


class Identify(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.simulated = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.simulated.cleanup)
        folder = pathlib.Path(cls.simulated.name)
        (folder / "s.toml").write_text(SCENARIO + "".join(f"{key} = {value}\n" for key, value in MUSCLE.items()))
        subprocess.run([SUPERCOIL_SIM, "run", "s.toml", "--out", "out", "--no-plot", "--no-can", "--quiet"],
                       cwd=folder, check=True)
        cls.trace = folder / "out" / "trace.csv"
        with cls.trace.open() as file:
            cls.rows = list(csv.DictReader(file))

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)

    def identify(self, *arguments, status=0):
        done = subprocess.run([SUPERCOIL, "identify", *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.path, timeout=300)
        self.assertEqual(done.returncode, status, done.stderr + done.stdout)
        return done

    def write(self, name, head, rows):
        (self.path / name).write_text("\n".join([head, *(",".join(map(str, row)) for row in rows)]) + "\n")
        return name

    def samples(self):
        return [(float(r["time_s"]), float(r["measured_m"]), float(r["applied_power_W"])) for r in self.rows]

    def refused(self, rows, line, text, *arguments, head="time_s,position_m,power_W"):
        done = self.identify(self.write("r.csv", head, rows), *arguments, status=2)
        self.assertEqual(done.stdout, "")
        self.assertTrue(done.stderr.startswith(f"supercoil: r.csv:{line}: "), done.stderr)
        self.assertIn(text, done.stderr)

    def test_a_trace_gives_the_simulated_muscle(self):
        found = json.loads(self.identify(self.trace, "--json", "--stiffness", 25, "--thermal-mass", 0.25).stdout)
        self.assertTrue(found["is_muscle"])
        self.assertEqual(found["chosen"], "linear")
        for name, truth in (("gain_m_per_W", GAIN_M_PER_W), ("time_constant_s", TIME_CONSTANT_S)):
            for part in ("linear_fitted", "linear_whole"):
                value, deviation = found[part][name]["value"], found[part][name]["deviation"]
                self.assertAlmostEqual(value, truth, delta=0.002 * truth)
                self.assertAlmostEqual(value, truth, delta=4 * deviation)
        for key, truth in MUSCLE.items():
            tolerance = 0.25 if key in ("moving_mass_kg", "damping_Ns_per_m") else 0.005
            self.assertAlmostEqual(found["muscle"][key], truth, delta=tolerance * truth)
        linear = found["models"][0]
        self.assertGreater(linear["unseen_explained"], 0.999)
        self.assertLess(linear["unseen_rms_m"], 20e-6)
        self.assertLess(found["change"]["deviations"], 3)

    def test_the_muscle_table_is_a_scenario(self):
        done = self.identify(self.trace, "--muscle", "m.toml", "--moving-mass", 0.12)
        self.assertIn("No change", done.stdout)
        self.assertNotIn("[muscle]", done.stdout)
        table = tomllib.loads((self.path / "m.toml").read_text())["muscle"]
        self.assertEqual(sorted(table), sorted(MUSCLE))
        self.assertEqual(table["moving_mass_kg"], 0.12)
        subprocess.run([SUPERCOIL_SIM, "run", "m.toml", "--check"], cwd=self.path, check=True, capture_output=True)

    def test_other_names_and_units_give_the_same(self):
        rows = [(1e3 * t, -1e3 * x, p / 2.5) for t, x, p in self.samples()]
        name = self.write("lab.csv", "Clock [ms],stretch (mm),level", rows)
        found = json.loads(self.identify(name, "--json", "--position-column", "stretch (mm)", "--position-scale", -1,
                                         "--power-column", 3, "--power-scale", 2.5).stdout)
        self.assertAlmostEqual(found["linear_whole"]["gain_m_per_W"]["value"], GAIN_M_PER_W, delta=1e-4)

    def test_a_plot_is_drawn(self):
        self.identify(self.trace, "--plot", "p.svg", "--from", 10, "--to", 90)
        self.assertIn("measured − predicted", (self.path / "p.svg").read_text())

    def test_only_the_figure_is_missing_if_it_cannot_be_drawn(self):
        done = self.identify(self.trace, "--plot", "none/p.svg", "--muscle", "m.toml", "--from", 10, "--to", 90, status=1)
        self.assertIn("none/p.svg", done.stderr)
        self.assertIn("motion explained", done.stdout)
        self.assertIn("[muscle]", (self.path / "m.toml").read_text())

    def test_spans_are_as_requested(self):
        found = json.loads(self.identify(self.trace, "--json", "--fit", "40:90", "--judge", "5:35").stdout)
        self.assertEqual((found["fitted_s"], found["unseen_s"]), ([40, 90], [5, 35]))
        for wrong, text in ((("--fit", "40"), "--fit 40: must be FROM:TO"),
                            (("--judge", "99.9:"), "50 samples or more"),
                            (("--fit", "0:60", "--judge", "50:90"), "must not overlap")):
            self.assertIn(text, self.identify(self.trace, *wrong, status=2).stderr)

    def test_wrong_recordings_are_refused_with_their_line(self):
        rows = self.samples()
        self.refused(rows[:500] + [("5.00", "abc", 1)] + rows[501:], 502, 'position_m: "abc" is not a number')
        self.refused(rows[:500] + rows[400:], 502, "the time goes back, from 4.99 to 4 s")
        self.refused(rows[:500] + rows[900:], 502, "rows are missing")
        highest = max(range(len(rows)), key=lambda i: rows[i][1])
        self.refused([(t, 1e3 * x, p) for t, x, p in rows], 2 + highest, "is it in another unit (--position-unit)?")
        self.refused([(t, x, 2) for t, x, _ in rows], 2, "power never changes from 2 W")
        self.refused(rows, 1, "the columns are time_s, position_m, heated", head="time_s,position_m,heated")

    def test_a_file_that_is_not_text_is_refused_without_printing_it(self):
        for content in ("time_s,position_m,power_W\n0,0,0\n".encode("utf-16"), b"\x93NUMPY\x01\x00v\x00{'descr': "):
            (self.path / "r.csv").write_bytes(content)
            self.assertEqual(self.identify("r.csv", status=2).stderr,
                             "supercoil: r.csv: is not text: it must be CSV in UTF-8, or a flight recording\n")

    def test_a_sensor_with_its_zero_far_away_gives_the_same(self):
        far = self.write("far.csv", "time_s,position_m,power_W", [(t, x + 0.5, p) for t, x, p in self.samples()])
        found = json.loads(self.identify(far, "--json", "--stiffness", 25, "--thermal-mass", 0.25).stdout)
        fitted = found["linear_whole"]
        self.assertAlmostEqual(fitted["gain_m_per_W"]["value"] / GAIN_M_PER_W, 1, delta=0.01)
        self.assertAlmostEqual(fitted["time_constant_s"]["value"] / TIME_CONSTANT_S, 1, delta=0.01)

    def test_a_recording_shorter_than_the_time_constant_is_refused(self):
        for start_s in (0, 20, 50):  # of 4.2 s
            done = self.identify(self.trace, "--from", start_s, "--to", start_s + 3, "--muscle", "m.toml", status=1)
            self.assertRegex(done.stdout, "No model is accepted: 3 s are too short: .* Record ten time constants")
            self.assertFalse((self.path / "m.toml").exists())

    def test_a_muscle_beyond_the_fits_limits_is_not_found(self):
        samples = self.samples()
        slow = []  # a time constant of 790 s, in rows 0.95 s apart
        for (t, x, p), (_, next_x, _) in itertools.pairwise(samples):
            slow += [(190 * t, x, p), (190 * (t + 0.005), (x + next_x) / 2, p)]
        done = self.identify(self.write("slow.csv", "time_s,position_m,power_W", slow), status=1)
        self.assertIn("the fit ended at its limit of time_constant_s, 742: ", done.stdout)

    def test_a_missing_channel_is_named(self):
        rows = [(t, x, p, 1) for t, x, p in self.samples()]
        channels = self.write("channels.csv", "time_s,position_m,power_W,channel", rows)
        self.assertIn("has no rows of channel 3", self.identify(channels, "--channel", 3, status=2).stderr)
        plain = self.write("plain.csv", "time_s,position_m,power_W", self.samples())
        self.assertIn("has no column named channel: leave out --channel", self.identify(plain, "--channel", 3, status=2).stderr)

    def test_lines_may_end_with_carriage_returns_alone(self):
        lines = ["time_s,position_m,power_W", *(f"{t},{x},{p}" for t, x, p in self.samples())]
        (self.path / "mac.csv").write_bytes("\r".join(lines).encode())
        self.assertIn("10000 rows", self.identify("mac.csv").stdout)

    def test_nan_is_no_option(self):
        for option in ("--thermal-mass", "--stiffness", "--moving-mass", "--power-scale", "--position-scale", "--from", "--to"):
            done = self.identify("trace.csv", option, "nan", status=2)
            self.assertIn(f"{option}: nan: must be a finite number", done.stderr)

    def test_a_gap_can_be_bridged(self):
        rows = self.samples()
        name = self.write("gap.csv", "time_s,position_m,power_W", rows[:500] + rows[540:])
        done = self.identify(name, "--bridge-gaps", "--json")
        self.assertIn("gap.csv:502: rows are missing in 1 places", done.stderr)

    def test_a_wire_with_a_phase_transformation_is_not_a_muscle(self):
        heat, rows = 0.0, []
        for k in range(6000):
            power = 4.0 if 500 <= k < 2500 or 3800 <= k < 5000 else 0.0
            rows.append((k / 100, 0.015 / (1 + math.exp(-(heat - 1.2) / 0.1)), power))
            heat += (power - heat) * 0.01 / 5.0
        name = self.write("wire.csv", "time_s,position_m,power_W", rows)
        done = self.identify(name, "--muscle", "m.toml", status=1)
        self.assertIn("No model is accepted: this is not a super-coiled polymer muscle", done.stdout)
        self.assertIn("shape-memory wire", done.stdout)
        self.assertIn("no [muscle] table is written", done.stderr)
        self.assertFalse((self.path / "m.toml").exists())
        self.assertFalse(json.loads(self.identify(name, "--json", status=1).stdout)["is_muscle"])

    def test_a_flight_recording_is_read(self):
        subprocess.run([WRITE_SAMPLE, self.path], check=True, capture_output=True)
        done = self.identify("flight-1.scfr", status=2)
        self.assertIn("flight-1.scfr: has 2 channels: choose one with --channel", done.stderr)
        # In the sample the power never moves the muscle: the checks must report that.
        self.assertIn("flight-1.scfr:", self.identify("flight-1.scfr", "--channel", 1, status=2).stderr)

    def test_the_recording_is_never_overwritten(self):
        name = self.write("r.csv", "time_s,position_m,power_W", self.samples())
        for option in ("--muscle", "--plot"):
            self.assertIn(f"{name}: would replace {name} itself", self.identify(name, option, name, status=2).stderr)


if __name__ == "__main__":
    unittest.main()
