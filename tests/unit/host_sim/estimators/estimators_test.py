"""supercoil-sim estimators as a user meets it: the same bytes whatever the jobs, and figures that hang together."""

import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(os.environ["SUPERCOIL_SIM"]).resolve()


class Estimators(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)

    def compare(self, *arguments, status=0):
        done = subprocess.run([PROGRAM, "estimators", *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.path, timeout=300)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def test_the_same_bytes_whatever_the_jobs(self):
        self.compare("--seeds", 1, "--no-plot", "--out", "one", "--jobs", 1)
        done = self.compare("--seeds", 1, "--no-plot", "--out", "two", "--jobs", 2)
        self.assertEqual((self.path / "one/estimators.csv").read_bytes(), (self.path / "two/estimators.csv").read_bytes())
        self.assertEqual(sorted(file.name for file in (self.path / "one").iterdir()), ["estimators.csv", "estimators.md"])
        self.assertIn((self.path / "two/estimators.md").read_text(), done.stdout)

        with open(self.path / "one/estimators.csv") as file:
            rows = {(row["trial"], row["estimator"], row["measure"]): row for row in csv.DictReader(file)}
        steady = {name: float(rows["nominal", name, "steady_rms_percent"]["theta1"])
                  for name in ("bound", "gradient", "least_squares", "ekf")}
        # 40 s of one seed may lie below the bound, but not far.
        self.assertTrue(0.5 < steady["bound"] < 0.7, steady)
        self.assertTrue(0.1 * steady["bound"] < steady["least_squares"] < 3.0 * steady["bound"], steady)
        self.assertTrue(0.1 * steady["bound"] < steady["ekf"] < 3.0 * steady["bound"], steady)
        self.assertGreater(steady["gradient"], 3.0 * steady["bound"])
        self.assertEqual(rows["nominal", "gradient", "reported_rms_percent"]["theta1"], "")

    def test_what_is_wrong_is_said(self):
        self.assertIn("--seeds", self.compare("--seeds", 0, status=2).stderr)
        (self.path / "file").write_text("")
        self.assertIn("file", self.compare("--seeds", 1, "--out", "file", status=2).stderr)


if __name__ == "__main__":
    unittest.main()
