"""Tests for every command of supercoil-sim that makes many runs; used together with ProgramCase."""

import csv
import signal
import subprocess
import time

from sim_program import PROGRAM


class Batch:
    ARGUMENTS = ()  # the command and its arguments
    MERGES = ()  # the command that merges parts
    KEPT_LINES = 0  # lines in runs.csv when a run is done

    _whole = None  # files from which all tests of a class start

    def run_batch(self, *arguments, status=0):
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def batch(self, *arguments, status=0):
        return self.run_batch(*self.ARGUMENTS, *arguments, status=status)

    def merge(self, out, *parts, status=0):
        return self.run_batch(*self.MERGES, "--merge", *parts, "--out", out, status=status)

    def files(self, folder):
        return {file.name: file.read_bytes() for file in (self.path / folder).iterdir()}

    def rows(self, folder, name="runs.csv"):
        with open(self.path / folder / name) as file:
            next(file)
            return list(csv.DictReader(file))

    def whole(self):
        """The files of all runs, which are also in whole/."""
        if self._whole is None:
            self.batch("--out", "whole", "--jobs", 1)
            type(self)._whole = self.files("whole")
        (self.path / "whole").mkdir(exist_ok=True)
        for name, text in self._whole.items():
            (self.path / "whole" / name).write_bytes(text)
        return dict(self._whole)

    def damaged(self, old, new, message):
        self.whole()
        runs = self.path / "whole/runs.csv"
        text = runs.read_text()
        self.assertIn(old, text)
        runs.write_text(text.replace(old, new, 1))
        before = self.files("whole")
        self.assertIn(message, self.batch("--out", "whole", status=2).stderr)
        self.assertEqual(self.files("whole"), before)

    def test_output_does_not_depend_on_the_number_of_jobs(self):
        whole = self.whole()
        self.batch("--out", "two", "--jobs", 2)
        self.assertEqual(self.files("two"), whole)

    def test_it_continues_after_it_was_killed(self):
        whole = self.whole()
        for number in (signal.SIGKILL, signal.SIGINT):
            out = self.path / number.name
            runs = out / "runs.csv"
            with subprocess.Popen([PROGRAM, *self.ARGUMENTS, "--out", out, "--jobs", "1"], cwd=self.path,
                                  stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as running:
                while not runs.is_file() or runs.read_text().count("\n") < self.KEPT_LINES:
                    self.assertIsNone(running.poll(), "it ended before a run had")
                    time.sleep(0.001)
                running.send_signal(number)
                stderr = running.communicate()[1]
            if running.returncode == 130:
                self.assertIn("the same command resumes from there", stderr)
            self.assertIn("are already in", self.batch("--out", out).stderr)
            self.assertEqual(self.files(out), whole)

    def test_merged_parts_equal_the_whole(self):
        whole = self.whole()
        for part in (1, 2, 3):
            self.batch("--out", f"part{part}", "--shard", f"{part}/3")
        self.merge("merged", *[f"part{part}/runs.csv" for part in (3, 1, 2)])
        self.assertEqual(self.files("merged"), whole)

    def test_merging_keeps_existing_files(self):
        whole = self.whole()
        for part in (1, 2):
            self.batch("--out", f"part{part}", "--shard", f"{part}/2")
        self.merge("part1", "part2/runs.csv")
        self.assertEqual(self.files("part1"), whole)

    def test_runs_that_are_not_a_file_are_named(self):
        (self.path / "out/runs.csv").mkdir(parents=True)
        self.assertIn("out/runs.csv: is not a file", self.batch("--out", "out", status=2).stderr)
