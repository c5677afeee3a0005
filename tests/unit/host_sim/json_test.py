"""The output of supercoil-sim's commands for programs: docs/json.md."""

import csv
import json
import signal
import subprocess
import unittest

from sim_program import PROGRAM, ProgramCase

# Short, with an event.
BRIEF = "[simulation]\nduration_s = 12.0\n[[event]]\nat_s = 11.0\nplant.stiffness_N_per_m = 12.0\n"
STUDY = """# Brief
[study]
runs = 4
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
"""


class Json(ProgramCase):
    def setUp(self):
        super().setUp()
        (self.path / "brief.toml").write_text(BRIEF)
        (self.path / "study.toml").write_text(STUDY)

    def output_of(self, *arguments, status=0):
        """Standard output is one object, which begins with the keys that all of them have."""
        done = self.run_program(*arguments, "--json")
        self.assertEqual(done.returncode, status, done.stderr)
        output = json.loads(done.stdout)
        self.assertEqual(list(output)[:2], ["schema_version", "program_version"])
        self.assertEqual(output["schema_version"], 1)
        return output

    def assert_rows_are_those_of(self, file, rows, text):
        """Numbers as numbers, flags as flags, and null where the file has nothing or a non-finite number."""
        with open(self.path / file) as lines:
            written = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        self.assertEqual(len(rows), len(written))
        for row, as_written in zip(rows, written):
            self.assertEqual(list(row), list(as_written))
            for column, cell in as_written.items():
                wanted = cell if column in text else {"": None, "inf": None, "yes": True, "no": False}.get(cell, cell)
                if wanted == cell and column not in text:
                    wanted = float(cell)
                self.assertEqual(row[column], wanted, column)

    def test_compare(self):
        output = self.output_of("compare", "--controllers", "pi,mrac-a", "--disturbances", "brief.toml,nominal", "--seeds", 1, "--no-plot",
                                "--out", "c")
        self.assertEqual((output["folder"], output["runs"]), ("c", 4))
        self.assert_rows_are_those_of("c/compare.csv", output["rows"], ("controller", "disturbance", "arithmetic", "measure"))
        self.assertIn(True, [row["met"] for row in output["rows"]])
        merged = self.output_of("compare", "--merge", "c/runs.csv", "--no-plot", "--out", "m")
        self.assertEqual(merged["rows"], output["rows"])

    def test_campaign(self):
        output = self.output_of("campaign", "study.toml", "--no-plot", "--out", "c")
        self.assertEqual((output["folder"], output["runs"]), ("c", 8))
        self.assert_rows_are_those_of("c/campaign.csv", output["rows"], ("controller", "quantity"))
        merged = self.output_of("campaign", "study.toml", "--merge", "c/runs.csv", "--no-plot", "--out", "m")
        self.assertEqual(merged["rows"], output["rows"])

    def test_search(self):
        output = self.output_of("campaign", "study.toml", "--search", 12, "--no-plot", "--out", "s")
        self.assertEqual([(row["controller"], row["quantity"], row["max"], row["fault"], row["file"]) for row in output["rows"]],
                         [(name, *goal, "", f"search-{name}.toml") for name in ("pi", "pd_ff")
                          for goal in (("tracking_rms_m", 1e-3), ("faults", 0))])
        for row in output["rows"]:
            self.assertGreaterEqual(row["worst"], 0.0)
            self.assertGreater(row["runs"], 0)
            self.assertTrue((self.path / "s" / row["file"]).exists())

    def test_estimators(self):
        output = self.output_of("estimators", "--seeds", 1, "--no-plot", "--out", "e")
        self.assertEqual(output["folder"], "e")
        self.assert_rows_are_those_of("e/estimators.csv", output["rows"], ("trial", "estimator", "measure"))

    def test_reproduce(self):
        output = self.output_of("reproduce", "--no-plots", "--out", "r")
        with open(self.path / "r/reproduction.csv") as file:
            self.assertEqual(output["rows"], list(csv.DictReader(file)))

    def test_lists(self):
        for command, lists in (("compare", ("controllers", "disturbances", "measures")), ("campaign", ("studies", "quantities"))):
            output = self.output_of(command, "--list")
            self.assertEqual(list(output)[2:], list(lists))
            text = self.run_program(command, "--list").stdout
            for name in lists:
                self.assertTrue(output[name])
                for entry in output[name]:
                    self.assertEqual(list(entry), ["name", "description"])
                    self.assertIn(entry["name"], text)
                    self.assertIn(entry["description"], text)

    def test_errors_are_listed_as_problems(self):
        (self.path / "wrong.toml").write_text(STUDY.replace("runs = 4", "runs = 0"))
        for key, message, arguments in (
                ("", "pr is none", ("compare", "--controllers", "pr is none")),
                ("", "no study given", ("campaign",)),
                ("study.runs", "must be", ("campaign", "wrong.toml")),
                ("", "/proc/none: cannot be created", ("estimators", "--out", "/proc/none")),
                ("", "/proc/none: cannot be created", ("reproduce", "--out", "/proc/none")),
                ("", "--slurm excludes --json", ("campaign", "study.toml", "--slurm", 2)),
                ("", "--bogus is not an option", ("compare", "--bogus")),
                ("", "'fly' is not a command", ("fly",))):
            with self.subTest(arguments=arguments):
                done = self.run_program(*arguments, "--json")
                self.assertEqual((done.returncode, done.stderr), (2, ""))
                problem = json.loads(done.stdout)["problems"][0]
                self.assertEqual(list(problem), ["file", "line", "key", "value", "message"])
                self.assertEqual(problem["key"], key)
                self.assertIn(message, problem["message"])

    def test_a_run_in_real_time_prints_its_summary_at_its_end(self):
        with subprocess.Popen([PROGRAM, "run", "bench", "--real-time", "--can", "socketcand:0", "--json", "--out", "live"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.path) as run:
            self.assertRegex(run.stderr.readline(), r"^serving can0 on 127\.0\.0\.1:\d+ by the socketcand protocol\n$")
            run.send_signal(signal.SIGINT)
            output, _ = run.communicate(timeout=120)
        self.assertEqual(json.loads(output), json.loads((self.path / "live/summary.json").read_text()))


if __name__ == "__main__":
    unittest.main()
