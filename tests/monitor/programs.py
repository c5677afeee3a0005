"""A simulated board in real time and supercoil monitor, as a user starts them."""

import contextlib
import os
import pathlib
import random
import re
import select
import socket
import subprocess
import sys
import tempfile
import time
import unittest

with contextlib.suppress(PermissionError):  # root, as in a container: fewer commands expire, so it ends sooner
    os.setpriority(os.PRIO_PROCESS, 0, -15)
ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = ROOT / "build" / "release" / "bin"
SUPERCOIL = os.environ.get("SUPERCOIL", BIN / "supercoil")
# What this machine may need when it does other work.
SLACK_S = 10.0


def until(condition, patience_s=SLACK_S):
    end_s = time.monotonic() + patience_s
    while not condition():
        if time.monotonic() > end_s:
            raise AssertionError(f"not within {patience_s} s")
        time.sleep(0.05)


def command(source, *words):
    return subprocess.run([SUPERCOIL, "command", *words, "--can", source], capture_output=True, text=True, timeout=60)


def free_ports():
    """Two consecutive ports that nobody listens on: the page's and the stop's. They stay free until used, and after that:
    they are below those that the kernel gives to programs that connect, as other tests do by the thousand meanwhile."""
    first_given = int(pathlib.Path("/proc/sys/net/ipv4/ip_local_port_range").read_text().split()[0])
    while True:
        port = random.randrange(10000, max(first_given, 12000) - 1)
        with socket.socket() as first, socket.socket() as second, contextlib.suppress(OSError):
            first.bind(("127.0.0.1", port))
            second.bind(("127.0.0.1", port + 1))
            return port


class Program:
    """A program that runs until stop(); it is ready when it has printed what is waited for."""

    def __init__(self, command, ready, patience_s=20.0, prepare=None):
        self.folder = tempfile.TemporaryDirectory()  # of its own, for what it writes
        self.process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, text=True, bufsize=1,
                                        cwd=self.folder.name, preexec_fn=prepare)
        end_s = time.monotonic() + patience_s
        while True:
            left_s = end_s - time.monotonic()
            if left_s <= 0 or not select.select([self.process.stdout], [], [], left_s)[0]:
                self.stop()
                raise TimeoutError(f"{command}: did not print {ready!r} within {patience_s} s")
            line = self.process.stdout.readline()
            if not line:
                self.stop()
                raise ChildProcessError(f"{command}: ended with {self.process.returncode} before it printed {ready!r}")
            if found := re.search(ready, line):
                self.found = found
                return

    def stop(self):
        """May be called again."""
        self.process.terminate()
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.process.stdout.close()
        self.folder.cleanup()


def simulated_board(port=0, scenario="bench"):
    """Its .found[1] is the port of its socketcand: this one, or one at which another board may be started later."""
    program = os.environ.get("SUPERCOIL_SIM", BIN / "supercoil-sim")
    return Program([program, "run", scenario, "--real-time", "--can", f"socketcand:{port or free_ports()}"],
                   r"serving can0 on 127\.0\.0\.1:(\d+)")


class OnSimulatedBoard(unittest.TestCase):
    """Tests that share a simulated board and its bus."""

    scenario = "bench"

    @classmethod
    def setUpClass(cls):
        cls.board = simulated_board(scenario=cls.scenario)
        cls.addClassCleanup(cls.board.stop)
        cls.source = f"socketcand:{cls.board.found[1]}"


def log_of(scenario, folder):
    """The can.log of a scenario that is simulated into the folder."""
    program = os.environ.get("SUPERCOIL_SIM", BIN / "supercoil-sim")
    subprocess.run([program, "run", scenario, "--out", folder, "--no-trace", "--no-plot", "--quiet"], check=True, timeout=120)
    return pathlib.Path(folder) / "can.log"


def with_second_node(log, lag_s):
    """The same log with the same muscle once more, later, as node 2: the identifiers that follow node 1's."""
    frames = []
    for line in log.read_text().splitlines():
        time_s, interface, frame = line.split()
        identifier, _, data = frame.partition("#")
        frames.append((float(time_s.strip("()")), interface, int(identifier, 16), data))
    frames += [(time_s + lag_s, interface, identifier + 1, data) for time_s, interface, identifier, data in frames]
    both = log.with_name("both.log")
    both.write_text("".join(f"({time_s:.6f}) {interface} {identifier:03X}#{data}\n"
                            for time_s, interface, identifier, data in sorted(frames)))
    return both


def monitor(source, *options, prepare=None):
    """Its .found[0] is the page's address as it is printed, .found[1] without the token. prepare: called in its process."""
    return Program([SUPERCOIL, "monitor", source, "--port", free_ports(), *options],
                   r"(http://[^#\s]+/)(#token=[0-9a-f]+)?", prepare=prepare)


def trickle(port, count=1000):
    """This many connections to the port that never end a request."""
    return Program([sys.executable, ROOT / "tests" / "monitor" / "trickle.py", port, count], "trickling")
