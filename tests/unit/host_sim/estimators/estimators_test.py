"""supercoil-sim estimators as seen by a user: the same bytes with any number of jobs, and consistent figures."""

import csv
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = pathlib.Path(os.environ["SUPERCOIL_SIM"]).resolve()


class Estimators(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """All runs of one seed on two threads; the other runs are compared with these."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.whole = pathlib.Path(folder.name) / "whole"
        cls.output = subprocess.run([PROGRAM, "estimators", "--seeds", "1", "--no-plot", "--out", cls.whole, "--jobs", "2"],
                                    capture_output=True, text=True, check=True, timeout=300).stdout

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)

    def compare(self, *arguments, status=0):
        done = subprocess.run([PROGRAM, "estimators", *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.path, timeout=300)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def test_output_does_not_depend_on_the_number_of_jobs(self):
        self.compare("--seeds", 1, "--no-plot", "--out", "one", "--jobs", 1)
        self.assertEqual((self.path / "one/estimators.csv").read_bytes(), (self.whole / "estimators.csv").read_bytes())
        self.assertEqual(sorted(file.name for file in (self.path / "one").iterdir()), ["estimators.csv", "estimators.md", "runs.csv"])
        self.assertEqual((self.path / "one/runs.csv").read_bytes(), (self.whole / "runs.csv").read_bytes())
        self.assertIn((self.whole / "estimators.md").read_text(), self.output)

        with open(self.path / "one/estimators.csv") as file:
            rows = {(row["trial"], row["estimator"], row["measure"]): row for row in csv.DictReader(file)}
        steady = {name: float(rows["nominal", name, "steady_rms_percent"]["theta1"])
                  for name in ("bound", "gradient", "least_squares", "ekf")}
        # 40 s with one seed may be below the bound, but not by much.
        self.assertTrue(0.5 < steady["bound"] < 0.7, steady)
        self.assertTrue(0.1 * steady["bound"] < steady["least_squares"] < 3.0 * steady["bound"], steady)
        self.assertTrue(0.1 * steady["bound"] < steady["ekf"] < 3.0 * steady["bound"], steady)
        self.assertGreater(steady["gradient"], 3.0 * steady["bound"])
        self.assertEqual(rows["nominal", "gradient", "reported_rms_percent"]["theta1"], "")

    def test_it_continues_after_it_was_interrupted(self):
        for number, status in ((signal.SIGKILL, -9), (signal.SIGINT, 130)):
            out = self.path / number.name
            with subprocess.Popen([PROGRAM, "estimators", "--seeds", "1", "--no-plot", "--out", out, "--jobs", "1"],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as running:
                while not (out / "runs.csv").is_file() or (out / "runs.csv").read_text().count("\n") < 5:
                    self.assertIsNone(running.poll(), "it ended before three runs had")
                    time.sleep(0.001)
                running.send_signal(number)
                stderr = running.communicate(timeout=60)[1]
            self.assertEqual(running.returncode, status, stderr)
            if number == signal.SIGINT:
                self.assertRegex(stderr, r"interrupted; \d+ runs are kept in .*runs.csv; the same command resumes")
            kept = (out / "runs.csv").read_text()
            (out / "runs.csv").write_text(kept + "nominal,gradient,7,0.1")  # torn
            done = self.compare("--seeds", 1, "--no-plot", "--out", out)
            self.assertIn(f"{kept.count(chr(10)) - 2} of 25 runs are already in", done.stderr)
            self.assertIn("its last line is incomplete", done.stderr)
            for name in ("estimators.csv", "runs.csv"):
                self.assertEqual((out / name).read_bytes(), (self.whole / name).read_bytes())

    def test_a_damaged_file_of_runs_is_refused_with_its_line(self):
        shutil.copytree(self.whole, self.path / "out")
        runs = self.path / "out/runs.csv"
        whole = runs.read_text()
        for text, message in ((whole.replace("nominal,gradient,1,", "nominal,gradient,x,", 1), "runs.csv:3: is damaged"),
                              (whole.replace("supercoil-sim ", "supercoil-sim 0.0", 1), "is of another version or definition")):
            runs.write_text(text)
            self.assertIn(message, self.compare("--seeds", 1, "--no-plot", "--out", "out", status=2).stderr)

    def test_errors_are_reported(self):
        self.assertIn("--seeds", self.compare("--seeds", 0, status=2).stderr)
        (self.path / "file").write_text("")
        self.assertIn("file", self.compare("--seeds", 1, "--out", "file", status=2).stderr)


if __name__ == "__main__":
    unittest.main()
