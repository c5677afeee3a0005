"""supercoil-sim compare as seen by a user: the same bytes with any number of jobs, resumed, in parts, and damaged."""

import csv
import subprocess
import unittest

from batch.batch import Batch
from sim_program import PROGRAM, ProgramCase

# Two short cells with two seeds each and an event.
BRIEF = "[simulation]\nduration_s = 30.0\n[[event]]\nat_s = 25.0\nplant.stiffness_N_per_m = 12.0\n"
CELLS = ["--controllers", "pi,mrac-a", "--disturbances", "brief.toml", "--seeds", "2", "--no-plot"]


class Compare(Batch, ProgramCase):
    ARGUMENTS = ("compare", *CELLS)
    MERGES = ("compare", "--no-plot")
    KEPT_LINES = 3

    def setUp(self):
        super().setUp()
        (self.path / "brief.toml").write_text(BRIEF)

    def compare(self, *arguments, status=0):
        return self.run_batch("compare", *arguments, status=status)

    def test_it_writes_runs_and_tables(self):
        self.assertEqual(sorted(self.whole()), ["compare.csv", "compare.md", "runs.csv"])

    def test_supercoil_sim_run_gives_the_same_figures(self):
        self.whole()
        text = BRIEF + "[controller]\nkind = 'pi'\n[estimator]\nkind = 'none'\n"
        (self.path / "s.toml").write_text(text.replace("[simulation]", "[simulation]\nseed = 2"))
        subprocess.run([PROGRAM, "run", "s.toml", "--window", "20:25", "--out", "run", "--no-plot", "--no-trace"],
                       check=True, cwd=self.path, capture_output=True)
        summary = (self.path / "run/summary.json").read_text()
        row, = [row for row in self.rows("whole") if (row["controller"], row["seed"]) == ("pi", "2")]
        self.assertIn(row["steady_rms_m"][:15], summary)

    def test_statistics_are_of_the_runs(self):
        self.whole()
        peaks = [float(row["peak_m"]) for row in self.rows("whole") if row["controller"] == "mrac-a"]
        with open(self.path / "whole/compare.csv") as file:
            self.assertIn("95 %", next(file))
            row, = [row for row in csv.DictReader(file) if (row["controller"], row["measure"]) == ("mrac-a", "peak_m")]
        mean = sum(peaks) / 2
        half = 12.7062 * abs(peaks[0] - peaks[1]) / 2  # Student's t for one degree of freedom
        self.assertAlmostEqual(float(row["mean"]), mean, delta=1e-5 * mean)
        self.assertAlmostEqual(float(row["worst"]), max(peaks), delta=1e-5 * mean)
        self.assertAlmostEqual(float(row["ci95_high"]), mean + half, delta=1e-5 * mean)
        self.assertAlmostEqual(float(row["ci95_low"]), mean - half, delta=1e-5 * mean)

    def test_only_missing_runs_are_repeated(self):
        whole = self.whole()
        runs = self.path / "whole/runs.csv"
        lines = runs.read_text().splitlines(keepends=True)
        runs.write_text("".join(lines[:-1]) + lines[-1][:20])
        output = self.batch("--out", "whole").stderr
        self.assertIn("its last line is incomplete; that run is repeated", output)
        self.assertIn("3 of 4 runs are already in", output)
        self.assertEqual(self.files("whole"), whole)

    def test_a_damaged_line_is_reported_with_its_number(self):
        self.damaged(",double,1,", ",double,x,", "runs.csv:3: is damaged")

    def test_another_version_is_refused(self):
        self.damaged("# supercoil-sim ", "# supercoil-sim 9", "runs.csv:1: is of another version or definition")

    def test_a_comment_is_no_other_definition(self):
        self.whole()
        (self.path / "brief.toml").write_text("# Another comment\n" + BRIEF + "# and another\n")
        self.assertIn("4 of 4 runs are already in", self.batch("--out", "whole").stderr)

    def test_a_controller_in_an_event_replaces_no_contender(self):
        event = "[simulation]\nduration_s = 3.0\n[[event]]\nat_s = 1.0\nplant.stiffness_N_per_m = 12.0\n"
        rows = []
        for name, more in (("plain", ""), ("other", "controller.kind = 'pi'\nestimator.kind = 'none'\n")):
            (self.path / name).mkdir()
            (self.path / name / "brief.toml").write_text(event + more)
            self.compare("--controllers", "pd_ff", "--disturbances", f"{name}/brief.toml", "--seeds", 1, "--no-plot",
                         "--out", f"{name}/out")
            rows.append(self.rows(f"{name}/out"))
        self.assertEqual(*rows)

    def test_steps_are_within_the_sine_of_the_file_which_may_be_a_joints(self):
        (self.path / "joint.toml").write_text("[joint]\n")
        # A sine of 5 mm at 0, which takes 20 s for 5 rad.
        self.compare("--controllers", "pi", "--disturbances", "joint.toml:steps", "--seeds", 1, "--no-plot",
                     "--out", "steps")
        row, = self.rows("steps")
        self.assertEqual(row["fault"], "")
        (self.path / "power.toml").write_text("reference.kind = 'steps'\n")
        refused = self.compare("--controllers", "pi", "--disturbances", "power.toml:steps", status=2)
        self.assertIn("--disturbances power:steps: its [reference] is of kind steps, but :steps needs a sine",
                      refused.stderr)

    def test_a_files_name_and_folder_may_contain_a_plus(self):
        (self.path / "a+b").mkdir()
        (self.path / "a+b/c+d.toml").write_text("simulation.duration_s = 1.0\n")
        names = "a+b/c+d.toml,a+b/c+d.toml:steps,a+b/c+d.toml+0.5"
        self.compare("--controllers", "pi", "--disturbances", names, "--seeds", 1, "--no-plot", "--out", "plus")
        self.assertEqual({row["disturbance"] for row in self.rows("plus")}, {"c+d", "c+d:steps", "c+d+0.5"})

    def test_nothing_to_run_is_refused(self):
        for arguments in (("--controllers", "pi", "--seeds", "1", "--shard", "3/5"),
                          ("--controllers", "learned_ff", "--arithmetic", "q8.24")):
            done = subprocess.run([PROGRAM, "compare", "--disturbances", "nominal", *arguments],
                                  cwd=self.path, capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("there is nothing to run", done.stderr)

    def test_another_definition_is_refused(self):
        self.whole()
        (self.path / "brief.toml").write_text(BRIEF.replace("12.0", "13.0"))
        output = self.batch("--out", "whole", status=2).stderr
        self.assertIn("runs.csv: its pi with brief was run with another definition", output)
        self.batch("--out", "other")
        output = self.merge("merged", "whole/runs.csv", "other/runs.csv", status=2).stderr
        self.assertIn("gave another result before", output)
        self.assertFalse((self.path / "merged").exists())

    def test_invalid_choices_are_refused_before_anything_is_written(self):
        for arguments, message in [
                (["--controllers", "pid"], "--controllers pid: must be a .toml file or one of: pi, pi-tuned, "),
                (["--disturbances", "stiffness+x"], "--disturbances stiffness+x: after + must come a time in seconds"),
                (["--disturbances", "none.toml"], "none.toml: there is no such file"),
                (["--arithmetic", "half"], "--arithmetic half: must be one of: double, float, q8.24"),
                (["--seeds", "0"], "--seeds 0: must be 1 to 100000"),
                (["--shard", "3/2"], "--shard 3/2: must be I/N with 1 <= I <= N"),
                (["--shard", "half"], "half: must be I/N"),
                (["--merge", "none.csv"], "none.csv: there is no such file")]:
            with self.subTest(arguments):
                self.assertIn(message, self.compare(*arguments, "--out", "out", status=2).stderr)
                self.assertFalse((self.path / "out").exists())

    def test_a_controllers_file_cannot_change_the_muscle_or_the_reference(self):
        (self.path / "mine.toml").write_text(
            "controller.kind = 'pi'\n[plant]\nstiffness_N_per_m = 12.0\n[reference]\nkind = 'steps'\n[reference_model]\n"
            "kind = 'eq8'\n")
        arguments = ["--controllers", "mine.toml", "--disturbances", "brief.toml", "--seeds", "1", "--out", "out"]
        output = self.compare(*arguments, status=2).stderr.splitlines()
        self.assertEqual([line.split(": ")[0:2] for line in output], [["mine.toml:2", "plant"], ["mine.toml:4", "reference"]])
        self.assertIn("belongs in a file for --disturbances", output[0])
        self.assertFalse((self.path / "out").exists())

    def test_controllers_that_do_not_fit_fixed_point_are_left_out(self):
        output = self.compare("--controllers", "pi,mrac-c", "--disturbances", "brief.toml", "--arithmetic",
                              "double,q8.24", "--seeds", "1", "--no-plot", "--out", "out").stderr
        self.assertIn("left out: ", output)
        self.assertIn("the covariance of mrac_ls does not fit q8.24", output)
        text = (self.path / "out/runs.csv").read_text()
        self.assertIn("pi,brief,q8.24,1,", text)
        self.assertNotIn("mrac-c,brief,q8.24", text)

    def test_a_fault_is_counted_and_ends_tracking(self):
        (self.path / "broken.toml").write_text(BRIEF.replace("plant.stiffness_N_per_m = 12.0", "injected_fault.heater_open = true"))
        self.compare("--controllers", "pi", "--disturbances", "broken.toml", "--seeds", "1", "--no-plot", "--out", "out")
        row, = self.rows("out")
        self.assertEqual((row["fault"], row["peak_m"], row["settling_s"]), ("heater_open", "inf", "inf"))
        self.assertIn("∞", (self.path / "out/compare.md").read_text())

    def test_a_table_without_a_finite_value_is_drawn(self):
        (self.path / "broken.toml").write_text(
            "[simulation]\nduration_s = 21.5\n[[event]]\nat_s = 0.5\ninjected_fault.heater_open = true\n")
        output = self.compare("--controllers", "pi", "--disturbances", "broken.toml", "--seeds", "1", "--out", "out").stderr
        self.assertEqual(output, "")
        self.assertIn("no value to draw", (self.path / "out/compare.svg").read_text())

    def test_a_later_disturbance_has_later_windows(self):
        self.compare("--controllers", "pi", "--disturbances", "brief.toml+5", "--seeds", "1", "--no-plot", "--out", "out")
        self.assertIn("pi,brief+5,double,1,", (self.path / "out/runs.csv").read_text())

    def test_steps_are_over_the_range_of_the_sine(self):
        (self.path / "steps.toml").write_text(
            BRIEF + "[reference]\nkind = 'steps'\nlevels_m = [0.005, 0.015, 0.008, 0.020]\nhold_s = 20.0\n")
        self.compare("--controllers", "pi", "--disturbances", "brief.toml:steps,steps.toml", "--seeds", "1", "--no-plot",
                     "--out", "out")
        with open(self.path / "out/runs.csv") as file:
            next(file)
            requested, written = csv.DictReader(file)
        self.assertEqual((requested["disturbance"], written["disturbance"]), ("brief:steps", "steps"))
        self.assertAlmostEqual(float(requested["peak_m"]), float(written["peak_m"]), delta=1e-9)

    def test_a_disturbance_may_tune_a_controller(self):
        (self.path / "tuned.toml").write_text(BRIEF + "[tuned.pi]\nintegral_W_per_m_s = 1e4\n")
        self.compare("--controllers", "pi,mrac-a", "--disturbances", "brief.toml,tuned.toml", "--seeds", "1", "--no-plot",
                     "--out", "out")
        with open(self.path / "out/runs.csv") as file:
            next(file)
            peaks = {(row["controller"], row["disturbance"]): float(row["peak_m"]) for row in csv.DictReader(file)}
        self.assertGreater(peaks["pi", "tuned"], 1.2 * peaks["pi", "brief"])
        self.assertEqual(peaks["mrac-a", "tuned"], peaks["mrac-a", "brief"])

    def test_list_names_all(self):
        listed = self.compare("--list").stdout
        for name in ("adaptive_ff", "mrac-c", "far_start", "settling_s"):
            self.assertIn(name, listed)
        self.assertFalse((self.path / "supercoil-out").exists())


if __name__ == "__main__":
    unittest.main()
