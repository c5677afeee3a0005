"""A program that hangs does not keep a muscle hot: its commands expire."""

import signal
import socket
import subprocess
import sys
import time
import unittest

from patience import DEADLINE_S, QUICK, TRIES, patient

import supercoil
from supercoil import Opcode, State, messages, sync
from supercoil.generated.names import Answers, Playback

# Holds the muscle until it is told otherwise.
PROGRAM = """
import sys, supercoil
with supercoil.Muscle(sys.argv[1], deadline_s=1e6) as muscle:
    if muscle.state == supercoil.State.fault:
        muscle.reset()
    muscle.arm()
    muscle.set_position(0.002)
    muscle.hold(1e6)
"""
# Plays a trajectory that takes a minute.
PLAYS = """
import sys, supercoil
with supercoil.Muscle(sys.argv[1], deadline_s=1e6) as muscle:
    if muscle.state == supercoil.State.fault:
        muscle.reset()
    muscle.arm()
    muscle.play([i * 0.1 for i in range(600)], [0.002 + i * 2e-6 for i in range(600)], settle_s=0.0)
"""
# End without close().
ENDS = """
import sys, supercoil
muscle = supercoil.sync.Muscle(sys.argv[1], deadline_s=1e6).connect()
if muscle.state == supercoil.State.fault:
    muscle.reset()
muscle.arm()
muscle.set_position(0.002)
muscle.hold(0.5)
"""
ENDS_ASYNCIO = """
import asyncio, sys, supercoil
async def main():
    muscle = await supercoil.Muscle(sys.argv[1], deadline_s=1e6).connect()
    if muscle.state == supercoil.State.fault:
        await muscle.reset()
    await muscle.arm()
    await muscle.set_position(0.002)
    await muscle.hold(0.5)
asyncio.run(main())
"""
ENDS_SIMULATION = """
import sys, supercoil
from supercoil import sync
from supercoil.keeper import Keeper
end = Keeper.end
async def reported(keeper):
    try:
        await end(keeper)
        print("disarmed", flush=True)
    except supercoil.NoAnswerError:
        print("no answer", flush=True)
Keeper.end = reported
simulation = sync.Simulation(sys.argv[1]).start()
simulation.muscle.arm()
"""
# Prints where its simulation serves, and waits.
SIMULATES = """
import sys, time
from supercoil import sync
simulation = sync.Simulation(sys.argv[1]).start()
print(simulation.address.split(":")[1], flush=True)
time.sleep(1e6)
"""
RENEWING = (Opcode.position, Opcode.renew)


class Hang(unittest.TestCase):
    def setUp(self):
        self.simulation = sync.Simulation(QUICK).start()
        self.addCleanup(self.simulation.stop)
        self.observer = self.simulation.muscle

    def observe(self, wanted):
        end = time.monotonic() + DEADLINE_S
        while not wanted(self.observer):
            self.assertLess(time.monotonic(), end, "never seen")
            time.sleep(0.01)

    def running(self, program, seen):
        """Its process, once its effect on the muscle is seen."""
        for _ in range(TRIES):
            process = subprocess.Popen([sys.executable, "-c", program, self.simulation.address], stderr=subprocess.PIPE,
                                       text=True)
            self.addCleanup(process.communicate)
            self.addCleanup(process.kill)
            self.observe(lambda m, process=process: seen(m) or process.poll() is not None)
            if process.poll() is None:
                return process
        self.fail(process.communicate()[1])

    @patient
    def test_the_command_of_a_stopped_process_expires(self):
        process = self.running(PROGRAM, lambda m: m.state == State.active)
        with self.observer.record() as recording:
            self.observer.hold(1.0)
            process.send_signal(signal.SIGSTOP)
            self.observe(lambda m: m.state == State.fault)
            self.observe(lambda _: any(recording.of(messages.FirstCause)))
        expired, = [message for message in recording.of(messages.Emergency) if message.fault != supercoil.Fault.none]
        self.assertEqual(expired.fault, supercoil.Fault.command_timeout)
        renewed = [message.time_s for message in recording.of(messages.Acknowledge) if message.opcode in RENEWING]
        # By the board's clock.
        self.assertAlmostEqual(expired.time_s - renewed[-1], 0.25, delta=0.02)
        self.assertGreater(len(renewed), 8)
        self.assert_raises_when_resumed(process)

    def assert_raises_when_resumed(self, process):
        process.send_signal(signal.SIGCONT)
        self.assertIn("supercoil.generated.faults.CommandTimeout", process.communicate(timeout=DEADLINE_S)[1])
        self.assertEqual(process.returncode, 1)

    @patient
    def test_a_trajectory_of_a_stopped_process_expires(self):
        with self.observer.record() as recording:
            process = self.running(PLAYS, lambda m: (message := m.telemetry.newest(messages.Trajectory)) is not None
                                   and message.playback == Playback.playing)
            self.observer.hold(1.0)
            process.send_signal(signal.SIGSTOP)
            self.observe(lambda m: m.state == State.fault and m.telemetry.power.applied_W == 0.0)
            self.observe(lambda m: m.telemetry.newest(messages.Trajectory).playback == Playback.empty)
        expired = [message for message in recording.of(messages.Emergency) if message.fault != supercoil.Fault.none][-1]
        self.assertEqual(expired.fault, supercoil.Fault.command_timeout)
        renewed = [message.time_s for message in recording.of(messages.Acknowledge) if message.opcode in RENEWING]
        answers = [message for message in recording.of(messages.Trajectory) if message.answers != Answers.nothing]
        renewed += [one.time_s for one in answers if one.answers == Answers.knot]
        # By the board's clock.
        self.assertAlmostEqual(expired.time_s - max(renewed), 0.25, delta=0.02)
        self.assertEqual(answers[-1].playback, Playback.playing)
        self.assertGreater(answers[-1].buffered_s, 3.0)
        self.assert_raises_when_resumed(process)

    def check_disarms(self, program):
        with self.observer.record() as recording:
            process = self.running(program, lambda m: m.state == State.active)
            errors = process.communicate(timeout=DEADLINE_S)[1]
            self.observe(lambda m: m.state in (State.disarmed, State.fault) and not m.telemetry.status.leased)
        if self.observer.fault == supercoil.Fault.command_timeout:
            raise supercoil.faults.CommandTimeout(self.observer.node)
        self.assertEqual((process.returncode, errors), (0, ""))
        self.assertIn(Opcode.disarm, [message.opcode for message in recording.of(messages.Acknowledge)])

    @patient
    def test_a_program_that_ends_without_close_disarms_its_muscle(self):
        self.check_disarms(ENDS)

    @patient
    def test_asyncio_run_disarms_what_was_not_closed(self):
        self.check_disarms(ENDS_ASYNCIO)


class Orphan(unittest.TestCase):
    @patient
    def test_a_muscle_is_disarmed_before_its_simulation_is_killed(self):
        done = subprocess.run([sys.executable, "-c", ENDS_SIMULATION, QUICK], capture_output=True, text=True,
                              timeout=DEADLINE_S)
        if done.returncode != 0 or done.stdout == "no answer\n":
            raise supercoil.NoAnswerError(done.stderr)
        self.assertEqual(done.stdout, "disarmed\n", done.stderr)

    def test_a_simulation_ends_with_its_killed_parent(self):
        process = subprocess.Popen([sys.executable, "-c", SIMULATES, str(QUICK)], stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        address = ("127.0.0.1", int(process.stdout.readline()))
        socket.create_connection(address).close()
        process.kill()
        end = time.monotonic() + DEADLINE_S
        with self.assertRaises(ConnectionRefusedError):
            while time.monotonic() < end:
                socket.create_connection(address).close()
                time.sleep(0.05)


if __name__ == "__main__":
    unittest.main()
