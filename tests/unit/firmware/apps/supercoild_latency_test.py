"""supercoild --latency: what it prints, draws and refuses, regardless of this machine's speed."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["SUPERCOILD"]
EXAMPLES = pathlib.Path(os.environ["SUPERCOIL_EXAMPLES"])
# Ordinary threads, so that a machine busy with tests is not held up.
GENTLE = ("--latency", "--priority", "0")


class Latency(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=self.path, timeout=120)

    def test_json_is_complete_and_consistent(self):
        done = self.run_program(*GENTLE, "--ticks", 500, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        report = json.loads(done.stdout)
        self.assertEqual((report["rate_Hz"], report["channels"], report["priority"], report["set_up"], report["ticks"]),
                         (1000.0, 1, 0, [], 500))
        self.assertGreaterEqual(report["overruns"], 0)
        for part in ("late", "tick"):
            h = report[part]
            self.assertEqual(sum(count for _, count in h["histogram"]), 500)
            order = [h[key + "_us"] for key in ("p50", "p99", "p99.9", "p99.99", "max")]
            self.assertEqual(order, sorted(order))
            self.assertLessEqual(h["min_us"], h["mean_us"])
            self.assertLessEqual(h["mean_us"], h["max_us"])
            starts = [start for start, _ in h["histogram"]]
            self.assertEqual(starts, sorted(set(starts)))
            self.assertLessEqual(starts[0], h["min_us"])
        # A tick takes some time, but less than a millisecond.
        self.assertGreater(report["tick"]["min_us"], 0.0)
        self.assertLess(report["tick"]["p50_us"], 1000.0)

    def test_text_and_progress(self):
        done = self.run_program(*GENTLE, "--seconds", 2.5, "--rate", 200)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"\A(supercoild: \d+ of 500 ticks, the latest \d+ us after its time\n)+\Z")
        self.assertTrue(done.stdout.startswith("500 ticks at 200 Hz, 1 channel, as an ordinary thread; overruns: "))
        for line in ("woke after its time, us\n", "a tick took, us\n", "  p99.99 ", "  max "):
            self.assertIn(line, done.stdout)

    def test_a_real_configuration_without_its_board(self):
        done = self.run_program(*GENTLE, "--ticks", 30, "--json", "--config",
                                EXAMPLES / "raspberry-pi-pca9685-ads1115.toml")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        report = json.loads(done.stdout)
        self.assertEqual((report["rate_Hz"], report["channels"], report["ticks"]), (100.0, 4, 30))

    def test_real_time_set_up_is_reported_whether_it_worked_or_not(self):
        done = self.run_program("--latency", "--priority", 1, "--cpu", 0, "--ticks", 20, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        steps = json.loads(done.stdout)["set_up"]
        self.assertEqual([step["step"] for step in steps],
                         ["memory locked", "CPUs kept from deep sleep", "priority 1 of SCHED_FIFO", "on CPU 0 alone"])
        for step in steps:
            self.assertIn(f"supercoild: {'' if step['worked'] else 'warning: not '}{step['step']}", done.stderr)

    def test_it_opens_nothing_that_could_heat(self):
        if not shutil.which("strace") or subprocess.run(["strace", "true"], capture_output=True).returncode != 0:
            self.skipTest("strace is not here, or may not trace")
        done = subprocess.run(["strace", "-f", "-e", "trace=openat,open", PROGRAM, *GENTLE, "--ticks", "20", "--config",
                               str(EXAMPLES / "raspberry-pi-pca9685-ads1115.toml")],
                              capture_output=True, text=True, cwd=self.path, timeout=120,
                              # The leak detector would trace as well, and only one tracer is allowed.
                              env=os.environ | {"ASAN_OPTIONS": "detect_leaks=0"})
        self.assertEqual(done.returncode, 0, done.stderr)
        for folder in ("/dev/gpiochip", "/sys/class/pwm", "/sys/bus/iio", "/dev/watchdog"):
            self.assertNotIn(f'"{folder}', done.stderr)

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_a_plot(self):
        done = self.run_program(*GENTLE, "--ticks", 50, "--plot", "a.svg")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("50 ticks at 1000 Hz", (self.path / "a.svg").read_text())
        self.assertEqual([file.name for file in self.path.iterdir()], ["a.svg"])

    def test_a_plot_that_cannot_be_drawn_keeps_the_measurements(self):
        done = self.run_program(*GENTLE, "--ticks", 50, "--plot", "none/a.svg")
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stdout.startswith("50 ticks"))
        self.assertIn("supercoild: problem: none/a.svg.gnuplot: cannot be written: No such file or directory\n",
                      done.stderr)

    def start(self, *arguments, **options):
        program = subprocess.Popen([PROGRAM, *GENTLE, *map(str, arguments), "--json"], cwd=self.path,
                                   stdout=subprocess.PIPE, text=True, **options)
        self.addCleanup(program.stdout.close)
        return program

    def test_a_signal_ends_it_with_the_measurements_so_far(self):
        for ends in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(ends.name):
                program = self.start("--seconds", 600)
                time.sleep(1)
                program.send_signal(ends)
                out, _ = program.communicate(timeout=60)
                self.assertEqual(program.returncode, 0)
                self.assertLess(0, json.loads(out)["ticks"])

    def test_under_nohup_it_continues_when_its_terminal_is_closed(self):
        program = self.start("--ticks", 2000, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        time.sleep(1)
        program.send_signal(signal.SIGHUP)
        out, _ = program.communicate(timeout=60)
        self.assertEqual((program.returncode, json.loads(out)["ticks"]), (0, 2000))

    def test_it_continues_when_its_log_is_no_longer_read(self):
        reader, log = os.pipe()
        os.close(reader)
        # Long enough to report its progress every second.
        program = self.start("--ticks", 2500, stderr=log)
        os.close(log)
        out, _ = program.communicate(timeout=60)
        self.assertEqual((program.returncode, json.loads(out)["ticks"]), (0, 2500))

    def test_wrong_options(self):
        for arguments in (("--rate", 500), ("--json",), ("--latency", "--rate", 50), ("--latency", "--ticks", 0),
                          ("--latency", "--ticks", 10, "--seconds", 1), ("--latency", "--check", "a.toml"),
                          ("--latency", "--rate", 500, "--config", "a.toml"), ("--latency", "--config", "none.toml")):
            with self.subTest(arguments):
                done = self.run_program(*arguments)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertNotEqual(done.stderr, "")


if __name__ == "__main__":
    unittest.main()
