"""Three boards on one simulated bus: each is commanded alone, by the package and by supercoil."""

import asyncio
import json
import os
import pty
import re
import subprocess
import time
import unittest
import urllib.request

from patience import DEADLINE_S, QUICK, TRIES, patient

import supercoil
from supercoil import State, sync

SUPERCOIL = os.environ["SUPERCOIL"]
NODES = (1, 2, 3)


class ThreeNodes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.simulation = sync.Simulation(QUICK, options=("--nodes", "3"), deadline_s=60.0).start()
        cls.addClassCleanup(cls.simulation.stop)
        cls.address = cls.simulation.address
        cls.observers = {}  # never command
        for node in NODES:
            cls.observers[node] = sync.Muscle(cls.address, node).connect()
            cls.addClassCleanup(cls.observers[node].close)

    def setUp(self):
        """An earlier test, or an earlier try, leaves nothing behind."""
        for node in NODES:
            with sync.Muscle(self.address, node) as muscle:
                if muscle.state == State.fault:
                    muscle.reset()
                muscle.disarm()

    def states(self):
        return [self.observers[node].state for node in NODES]

    def observe(self, wanted):
        end = time.monotonic() + DEADLINE_S
        while not wanted():
            self.assertLess(time.monotonic(), end, "never seen")
            time.sleep(0.01)

    def supercoil(self, *words):
        """What it prints. A lease that ended meanwhile is claimed again."""
        for _ in range(TRIES):
            done = subprocess.run([SUPERCOIL, *words, "--can", self.address], capture_output=True, text=True,
                                  timeout=DEADLINE_S)
            if done.returncode == 0:
                return done.stdout
        self.fail(done.stderr)

    def test_each_node_is_commanded_and_tuned_separately(self):
        for node in NODES:
            self.supercoil("command", str(node), "arm")
            armed = [State.armed if one == node else State.disarmed for one in NODES]
            self.observe(lambda armed=armed: self.states() == armed)
            self.supercoil("command", str(node), "disarm")
            self.observe(lambda: self.states() == [State.disarmed] * 3)
        self.supercoil("tune", "2", "proportional_W_per_m=1234")
        self.assertEqual([self.observers[node].tuning()["proportional_W_per_m"].in_use for node in NODES],
                         [2000.0, 1234.0, 2000.0])

    @patient
    def test_one_call_moves_each_node_to_its_own_set_point(self):
        async def in_step():
            muscles = [supercoil.Muscle(self.address, node, deadline_s=60.0) for node in NODES]
            for muscle in muscles:
                await muscle.connect()
            try:
                for muscle in muscles:
                    await muscle.arm()
                for step in range(50):
                    await supercoil.cycle([muscle.make_position(step * 1e-5 + muscle.node * 1e-4)
                                           for muscle in muscles])
                    await asyncio.sleep(0.02)
                await asyncio.gather(*(muscle.hold(0.2) for muscle in muscles))
                return [muscle.telemetry.tracking.reference_m for muscle in muscles]
            finally:
                for muscle in muscles:
                    await muscle.close()
        self.assertEqual(asyncio.run(in_step()), [0.00059, 0.00069, 0.00079])

    @patient
    def test_a_fault_affects_only_its_node(self):
        with sync.Muscle(self.address, 2, deadline_s=60.0) as other:
            other.arm()
            self.supercoil("command", "3", "arm")
            self.supercoil("command", "3", "power", "0.2")  # once: it expires
            self.observe(lambda: self.observers[3].fault == supercoil.Fault.command_timeout)
            self.assertEqual([self.observers[node].fault for node in (1, 2)], [supercoil.Fault.none] * 2)
            self.assertEqual(other.state, State.armed)
        nodes = json.loads(self.supercoil("command", "state", "--json"))["nodes"]
        self.assertEqual([one["Status"]["fault"] for one in nodes], ["none", "none", "command_timeout"])

    def on_terminal(self, *words):
        """What is seen until it says how much longer it will take; empty when it ended before that."""
        screen, terminal = pty.openpty()
        running = subprocess.Popen([SUPERCOIL, "command", *words, "--can", self.address], stderr=terminal)
        os.close(terminal)
        seen = ""
        try:
            while " left" not in seen:
                seen += os.read(screen, 4096).decode()
        except OSError:  # the end of a terminal
            return ""
        finally:
            running.terminate()
            running.wait()
            os.close(screen)
        return seen

    def test_progress_is_shown_on_a_terminal(self):
        for words in (("1", "identify", "--for", "600"), ("1", "power", "0.1", "--for", "100")):
            for _ in range(TRIES):
                self.setUp()
                self.supercoil("command", "1", "arm")
                if seen := self.on_terminal(*words):
                    break
            self.assertRegex(seen, rf"\r\x1b\[K{' '.join(words[:-2])}: \d+ %, \d+ (s|min) left")

    def test_progress_is_not_shown_in_a_pipe(self):
        for _ in range(TRIES):
            self.setUp()
            self.supercoil("command", "1", "arm")
            # A terminal would show it from 2 s on.
            done = subprocess.run([SUPERCOIL, "command", "1", "power", "0.1", "--for", "3", "--can", self.address],
                                  capture_output=True, text=True, timeout=DEADLINE_S)
            if done.returncode == 0:
                break
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_all_nodes_are_listed(self):
        self.assertEqual([found.node for found in sync.discover(self.address)], [1, 2, 3])
        nodes = json.loads(self.supercoil("command", "state", "--json"))["nodes"]
        self.assertEqual([one["node"] for one in nodes], [1, 2, 3])
        page = subprocess.Popen([SUPERCOIL, "monitor", self.address, "--port", "0"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(page.communicate)
        self.addCleanup(page.terminate)
        address = re.search(r"http://[^#\s]+/", page.stdout.readline())[0]

        def listed():
            with urllib.request.urlopen(address + "api/history?from_s=-1") as response:
                return sorted(json.load(response)["nodes"])
        self.observe(lambda: listed() == ["1", "2", "3"])


if __name__ == "__main__":
    unittest.main()
