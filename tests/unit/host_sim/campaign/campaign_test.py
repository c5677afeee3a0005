"""supercoil-sim campaign as seen by a user: the same bytes with any number of jobs, resumed, in parts, replayed, damaged."""

import csv
import json
import os
import pathlib
import shutil
import subprocess
import unittest

from batch.batch import Batch
from sim_program import PROGRAM, ProgramCase

RECIPES = pathlib.Path(__file__).resolve().parents[4] / "examples/campaign"

# Short runs, some of which fail and some of which are refused.
STUDY = """# Brief
[study]
runs = 24
scenario = "pwm"
controllers = ["pi", "pd_ff"]
window_s = [1.0, 3.0]
[goals]
tracking_rms_m = 1e-3
[scenario.simulation]
duration_s = 3.0
[[draw]]
keys = "plant.stiffness_N_per_m"
log_uniform = [8.0, 40.0]
[[draw]]
keys = "reference.offset_m"
uniform = [0.008, 0.0125]
[[draw]]
name = "noise"
keys = "sensor.position.noise_rms_m"
list = [1e-6, 1e-5]
"""
FIRST_LINES = 2  # the command that made it, and the column names


class Campaign(Batch, ProgramCase):
    ARGUMENTS = ("campaign", "brief.toml", "--no-plot")
    MERGES = ARGUMENTS
    KEPT_LINES = 4

    def setUp(self):
        super().setUp()
        (self.path / "brief.toml").write_text(STUDY)

    def campaign(self, *arguments, study="brief.toml", status=0):
        return self.run_batch("campaign", *([study] if study else []), "--no-plot", *arguments, status=status)

    def test_each_run_is_a_line_and_all_runs_give_a_table(self):
        whole = self.whole()
        self.assertEqual([name for name in sorted(whole) if not name.startswith("worst-")],
                         ["campaign.csv", "campaign.md", "report.html", "runs.csv"])
        rows = self.rows("whole")
        self.assertEqual([(row["run"], row["contender"]) for row in rows],
                         [(str(run), name) for run in range(1, 25) for name in ("pi", "pd_ff")])
        refused = [row for row in rows if row["refused"]]
        self.assertTrue(0 < len(refused) < len(rows))
        for row in rows:
            # The sine's amplitude is 9 mm, and no position is below 0.
            self.assertEqual(bool(row["refused"]), float(row["reference.offset_m"]) < 0.009)
            self.assertIn(row["noise"], ("1e-06", "1e-05"))
        table = list(csv.DictReader(whole["campaign.csv"].decode().splitlines()))
        for name in ("pi", "pd_ff"):
            ran = [row for row in rows if row["contender"] == name and not row["refused"]]
            line, = [line for line in table if (line["controller"], line["quantity"]) == (name, "tracking_rms_m")]
            values = sorted(float(row["tracking_rms_m"]) for row in ran)
            self.assertEqual(int(line["runs"]), len(ran))
            self.assertEqual(int(line["failures"]), sum(value > 1e-3 for value in values))
            self.assertEqual(float(line["worst"]), values[-1])
            self.assertEqual(float(line["median"]), values[(len(values) + 1) // 2 - 1])
            line, = [line for line in table if (line["controller"], line["quantity"]) == (name, "refused")]
            self.assertEqual(int(line["failures"]), 24 - len(ran))

    def test_contenders_of_a_run_get_the_same_conditions(self):
        self.whole()
        rows = self.rows("whole")
        drawn = ("plant.stiffness_N_per_m", "reference.offset_m", "noise")
        for one, other in zip(rows[::2], rows[1::2]):
            self.assertEqual([one[name] for name in drawn], [other[name] for name in drawn])
        self.assertEqual(len({row["plant.stiffness_N_per_m"] for row in rows}), 24)

    def test_repeating_the_worst_run_gives_the_same_figures(self):
        self.whole()
        failed = [row for row in self.rows("whole") if not row["refused"] and float(row["tracking_rms_m"]) > 1e-3]
        self.assertTrue(failed)
        worst = max(failed, key=lambda row: float(row["tracking_rms_m"]))
        file = f"worst-{worst['contender']}-1.toml"
        self.assertTrue((self.path / "whole" / file).read_text().startswith(f"# Run {worst['run']} of brief, "))
        subprocess.run([PROGRAM, "run", f"whole/{file}", "--window", "1:3", "--out", "again", "--no-plot",
                        "--no-trace", "--no-can"], check=True, cwd=self.path, capture_output=True)
        summary = json.loads((self.path / "again/summary.json").read_text())
        self.assertEqual(summary["tracking_rms_m"], float(worst["tracking_rms_m"]))
        self.assertEqual(summary["tracking_max_m"], float(worst["tracking_max_m"]))

    def test_a_campaign_can_be_extended_to_more_runs(self):
        whole = self.whole()
        self.campaign("--out", "more", "--runs", 10)
        self.assertEqual(len(self.rows("more")), 20)
        self.assertIn("20 of 48 runs are already in", self.campaign("--out", "more").stderr)
        self.assertEqual(self.files("more")["runs.csv"], whole["runs.csv"])
        self.assertEqual(self.files("more")["campaign.csv"], whole["campaign.csv"])

    def test_it_ends_when_its_interval_is_narrow_enough(self):
        (self.path / "known.toml").write_text(STUDY.replace("runs = 24", "runs = 1000\nknown_to = 0.1")
                                              .replace("duration_s = 3.0", "duration_s = 0.5")
                                              .replace("[1.0, 3.0]", "[0.1, 0.5]"))
        self.campaign("--out", "one", "--jobs", 1, study="known.toml")
        rows = self.rows("one")
        self.assertEqual(len(rows) % 200, 0)
        self.assertLess(len(rows), 2000)
        for line in csv.DictReader((self.path / "one/campaign.csv").read_text().splitlines()):
            if line["quantity"] == "any":
                self.assertLessEqual(float(line["ci95_high"]) - float(line["ci95_low"]), 0.2)
        self.campaign("--out", "two", "--jobs", 2, study="known.toml")
        self.assertEqual(self.files("two"), self.files("one"))
        output = self.campaign("--out", "part", "--shard", "1/2", study="known.toml", status=2).stderr
        self.assertIn("study.known_to: one part cannot tell", output)

    def test_jobs_of_a_cluster_equal_the_whole(self):
        whole = self.whole()
        self.path = self.path / "what's $HOME"  # a shell must leave it unchanged
        self.path.mkdir()
        (self.path / "brief.toml").write_text(STUDY)
        output = self.campaign("--out", "array", "--slurm", 3, "--no-submit").stdout
        self.assertIn("to submit them: sh array/submit.sh", output)
        array = self.path / "array"
        for task in "312":
            subprocess.run(["sh", "part.sbatch"], cwd=array, check=True, env={**os.environ, "SLURM_ARRAY_TASK_ID": task})
        subprocess.run(["sh", "merge.sbatch"], cwd=array, check=True, stdout=subprocess.DEVNULL)
        self.assertIn(b"<figure", (array / "report.html").read_bytes())
        del whole["report.html"]  # without a figure
        self.assertEqual({name: (array / name).read_bytes() for name in whole}, whole)

    def test_jobs_in_containers_equal_the_whole(self):
        whole = self.whole()
        tools = self.path / "tools"
        tools.mkdir()
        # Stands in for Apptainer: `apptainer run IMAGE ARGUMENTS`.
        (tools / "apptainer").write_text('#!/bin/sh\n[ "$1 $2" = "run supercoil-sim.sif" ] || exit 1\n'
                                         f'shift 2\nexec "{PROGRAM}" "$@"\n')
        (tools / "apptainer").chmod(0o755)
        where = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "SLURM_ARRAY_TASK_COUNT": "3"}
        for task in "312":
            subprocess.run(["sh", RECIPES / "part.sbatch", "brief.toml"], cwd=self.path, check=True,
                           env={**where, "SLURM_ARRAY_TASK_ID": task})
        subprocess.run(["sh", RECIPES / "merge.sbatch", "brief.toml"], cwd=self.path, check=True, env=where,
                       stdout=subprocess.DEVNULL)
        del whole["report.html"]  # without a figure
        self.assertEqual({name: (self.path / "campaign" / name).read_bytes() for name in whole}, whole)

    def test_a_promise_is_kept_or_broken(self):
        self.campaign("--runs", 4, "--out", "kept", study="promise")
        for row in self.rows("kept"):
            promised, error = float(row["promised_rms_m"]), float(row["first_motion_rms_m"])
            self.assertEqual(row["promise_broken"], "1" if error > promised else "0")
            self.assertTrue(1e-5 < promised < 1e-4)

    def test_options_of_submit_reach_only_the_parts(self):
        tools = self.path / "tools"
        tools.mkdir()
        # sbatch --parsable with clusters prints the job's number and the cluster's name.
        (tools / "sbatch").write_text('#!/bin/sh\nfor word; do echo "$word"; done >> "$CALLS"\necho >> "$CALLS"\necho "17;mine"\n')
        (tools / "sbatch").chmod(0o755)
        self.campaign("--out", "array", "--slurm", 3, "--no-submit")
        done = subprocess.run(["sh", "array/submit.sh", "--cpus-per-task=8", "--comment=two words"], cwd=self.path,
                              env={"PATH": f"{tools}:{os.environ['PATH']}", "CALLS": str(self.path / "calls")},
                              capture_output=True, text=True, check=True)
        parts, merge = [call.split("\n") for call in (self.path / "calls").read_text().strip().split("\n\n")]
        self.assertIn("--array=1-3", parts)
        self.assertEqual(parts[-3:], ["--cpus-per-task=8", "--comment=two words", "part.sbatch"])
        self.assertIn("--dependency=afterok:17", merge)
        self.assertNotIn("--cpus-per-task=8", merge)
        self.assertEqual(done.stdout, "job 17 runs the parts, job 17 merges them\n")

    def test_other_goals_are_evaluated_from_the_same_runs(self):
        whole = self.whole()
        (self.path / "brief.toml").write_text(STUDY.replace("tracking_rms_m = 1e-3", "hottest_C = 60.0"))
        self.assertIn("48 of 48 runs are already in", self.batch("--out", "whole").stderr)
        self.assertEqual(self.files("whole")["runs.csv"], whole["runs.csv"])
        self.assertIn(b",hottest_C,", self.files("whole")["campaign.csv"])

    def test_without_sbatch_it_prints_the_commands(self):
        tools = self.path / "tools"
        tools.mkdir()
        for tool in ("sh", "dirname"):
            (tools / tool).symlink_to(shutil.which(tool))
        done = subprocess.run([PROGRAM, "campaign", "brief.toml", "--out", "array", "--slurm", "2"], cwd=self.path,
                              env={"PATH": str(tools)}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("sbatch", done.stderr)
        self.assertIn("on a machine with sbatch, run: sh array/submit.sh", done.stderr)

    def test_parts_with_missing_runs_are_reported(self):
        self.campaign("--out", "part1", "--shard", "1/3")
        output = self.campaign("--merge", "part1/runs.csv", "--out", "merged").stderr
        self.assertIn("the parts have 16 of the study's 48 runs", output)

    def test_a_search_finds_worse_runs_than_random_draws(self):
        self.whole()
        by_chance = {name: max(float(row["tracking_rms_m"]) for row in self.rows("whole")
                               if row["contender"] == name and not row["refused"]) for name in ("pi", "pd_ff")}
        for out, jobs in (("one", 1), ("two", 2)):
            self.campaign("--search", 70, "--out", out, "--jobs", jobs)
        self.assertEqual(self.files("one"), self.files("two"))
        self.assertEqual(sorted(self.files("one")), ["search-pd_ff.toml", "search-pi.toml", "search.md"])
        for name, chance in by_chance.items():
            subprocess.run([PROGRAM, "run", f"one/search-{name}.toml", "--window", "1:3", "--out", name, "--no-plot",
                            "--no-trace", "--no-can"], check=True, cwd=self.path, capture_output=True)
            found = json.loads((self.path / name / "summary.json").read_text())["tracking_rms_m"]
            self.assertGreater(found, chance)
            self.assertIn(f"{1e6 * found:.3g}" if found < 1e-3 else f"{1e6 * found:.0f}",
                          (self.path / "one/search.md").read_text())

    def test_a_damaged_line_is_reported_with_its_number(self):
        self.damaged("\n2,pi,", "\n2,mrac,", "runs.csv:5: is damaged: there is no such run")

    def test_a_line_with_other_draws_is_damaged(self):
        self.damaged("\n2,pi,", "\n2,pi,1", "runs.csv:5: is damaged: the study draws other values for this run")

    def test_results_of_another_study_are_refused(self):
        self.whole()
        (self.path / "brief.toml").write_text(STUDY.replace("0.0125", "0.0126"))
        output = self.campaign("--out", "whole", status=2).stderr
        self.assertIn("is of another version or definition", output)
        self.assertIn("Choose another --out, or delete it", output)

    def test_a_study_that_is_invalid_at_its_medians_is_refused_at_once(self):
        (self.path / "brief.toml").write_text(STUDY.replace("plant.stiffness_N_per_m", "plant.stifness_N_per_m"))
        output = self.campaign("--out", "none", status=2).stderr
        self.assertIn("at the median of all draws, with pi", output)
        self.assertIn("did you mean stiffness_N_per_m?", output)
        self.assertFalse((self.path / "none").exists())

    def test_check_runs_nothing_and_prints_the_keys(self):
        self.assertEqual(self.campaign("--check").stdout, "brief.toml: in order, 24 runs, controllers: 2, draws: 3\n")
        checked = json.loads(self.campaign("--check", "--json").stdout)
        self.assertEqual((checked["runs"], checked["controllers"], checked["draws"], checked["goals"]),
                         (24, ["pi", "pd_ff"], ["plant.stiffness_N_per_m", "reference.offset_m", "noise"],
                          {"tracking_rms_m": 1e-3, "faults": 0}))
        text = self.campaign("--check", "--keys").stdout
        self.assertRegex(text, r'\nstudy\.controllers +\["pi", "pd_ff"\] +none +5\n')
        self.assertRegex(text, r"\ngoals\.peak_m +none +none\n")
        self.assertRegex(text, r"\ndraw\[2\]\.uniform .* 2 numbers\n")
        keys = {key["key"]: key for key in json.loads(self.campaign("--check", "--keys", "--json").stdout)["keys"]}
        self.assertEqual([keys["study.runs"][name] for name in ("value", "default", "line", "min", "max")],
                         [24, 1000, 3, 1, 1000000])
        self.assertEqual((keys["study.window_s"]["default"], keys["study.window_s"]["max"]), ([1.5, 3], 3))
        self.assertEqual((keys["draw[1].keys"]["type"], keys["draw[1].keys"]["value"]),
                         ("texts", ["plant.stiffness_N_per_m"]))
        self.assertEqual((keys["draw[3].list"]["type"], keys["draw[3].list"]["value"]), ("values", [1e-6, 1e-5]))
        self.assertTrue(keys["draw[2].uniform"]["required"])
        self.assertEqual([keys[f"goals.{name}"]["default"] for name in ("faults", "tracking_rms_m")], [0, None])
        self.assertFalse((self.path / "supercoil-out").exists())

    def test_a_scenarios_file_is_named_where_it_is_wrong(self):
        (self.path / "base.toml").write_text("[plant]\nstiffness_N_per_m = = 3\n")
        (self.path / "brief.toml").write_text(STUDY.replace('"pwm"', '"base.toml"'))
        self.assertIn("base.toml:2: is not valid TOML", self.campaign("--out", "none", status=2).stderr)

    def test_without_draws_there_is_nothing_to_search(self):
        (self.path / "brief.toml").write_text(STUDY.split("[[draw]]")[0])
        output = self.campaign("--search", 5, "--out", "none", status=2).stderr
        self.assertIn("has no [[draw]]: nothing to search over", output)

    def test_it_lists_the_available_studies(self):
        output = self.campaign("--list", study=None).stdout
        for name in ("follows", "identify", "promise", "temperature", "hottest_C", "steady_rms_m"):
            self.assertIn(name, output)
        self.assertIn("no study given: name a TOML file or a study from --list", self.campaign(study=None, status=2).stderr)


if __name__ == "__main__":
    unittest.main()
