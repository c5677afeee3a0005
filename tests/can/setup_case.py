"""supercoil setup as tests start it: by itself, with a script, on a terminal."""

import fcntl
import os
import pathlib
import pty
import re
import select
import subprocess
import tempfile
import termios
import time
import unittest

from live import DEADLINE_S, TRIES

SUPERCOIL = os.environ["SUPERCOIL"]
SUPERCOILD = os.environ["SUPERCOILD"]
EXAMPLE = pathlib.Path(os.environ["SUPERCOIL_EXAMPLES"]) / "raspberry-pi-pwm-ads1115.toml"
ANSWERS = {"cold_resistance_Ohm": 10, "load_g": 90, "stretch_weight_g": 100, "stretch_mm": 55, "heated_W": 2.0,
           "heated_mm": 13, "half_cooling_s": 1.3, "thread_g": 0.1, "max_W": 4.5, "max_travel_mm": 25,
           "uncertainty_percent": 30}
RESTART = 3  # the board, with the changed file
# What a busy machine does to any master in real time.
STARVED = ("wrong_state", "no_lease", "no answer from node", "busy", "not_ready")


class Terminal:
    """supercoil setup, or another command, on a terminal of its own; its output is one text, as a person sees it come."""

    def __init__(self, *arguments, command="setup"):
        terminal, self.end = pty.openpty()
        self.file = terminal
        self.output = ""
        self.answers = 0
        self.program = subprocess.Popen([SUPERCOIL, command, *arguments], stdin=self.end, stdout=self.end, stderr=self.end,
                                        start_new_session=True, preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))
        os.close(self.end)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.program.poll() is None:
            self.program.kill()
        self.program.wait()
        os.close(self.file)

    def read(self):
        """False: the other end is closed."""
        try:
            if select.select([self.file], [], [], 0.1)[0]:
                self.output += os.read(self.file, 65536).decode()
            return True
        except OSError:
            return False

    def until(self, text, patience_s=DEADLINE_S):
        """text: may be a regular expression."""
        end_s = time.monotonic() + patience_s
        while not re.search(text, self.output):
            if not self.read() or time.monotonic() > end_s:
                raise AssertionError(f"no {text!r} in {self.output!r}")

    def type(self, text):
        os.write(self.file, text.encode())

    def answer(self, text):
        """Answers the question that follows those answered before."""
        self.answers += 1
        self.until(r"(?s)([)\]]: .*){%d}$" % self.answers)
        self.type(text + "\n")

    def ended(self):
        while self.read():
            pass
        return self.program.wait(timeout=DEADLINE_S)


class SetupCase(unittest.TestCase):
    """A board's file, and supercoil setup of it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        self.board = self.path / "board.toml"
        # Room for a muscle that rests lower in the coldest air than where its zero was taken.
        self.example = EXAMPLE.read_text().replace("min_m = -0.001", "min_m = -0.012")
        self.board.write_text(self.example)
        self.record = self.path / "board.toml.setup.json"

    def describe(self, *script):
        """Runs setup up to where the board has to be started with the file."""
        done = self.setup_program(*(script or self.script()))
        self.assertEqual((done.returncode, done.stderr), (RESTART, ""))
        return done

    def setup_program(self, *arguments, **options):
        return subprocess.run([SUPERCOIL, "setup", "--config", self.board, *arguments], capture_output=True, text=True,
                              timeout=DEADLINE_S, **options)

    def patiently(self, run, status=0):
        """Repeats while this program was kept from the processor for so long that its lease ended."""
        for _ in range(TRIES):
            done = run()
            if done.returncode == status or not any(why in done.stderr for why in STARVED):
                break
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def script(self, *tables, **changes):
        answers = {key: value for key, value in {**ANSWERS, **changes}.items() if value is not None}
        path = self.path / "answers.toml"
        path.write_text("[muscle]\n" + "".join(f"{key} = {value}\n" for key, value in answers.items()) + "\n".join(tables))
        return "--script", path

    def assert_refused(self, done, *expected):
        self.assertEqual(done.returncode, 2, done.stderr)
        for part in expected:
            self.assertIn(part, done.stderr)
        self.assertEqual(self.board.read_text(), self.example)
        self.assertFalse(self.record.exists())
