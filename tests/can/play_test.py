"""supercoil play: motions of a file on two simulated boards of one bus, in real time over socketcand."""

import json
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import threading
import time
import unittest

import e2e
import numpy as np
from between import Between
from live import DEADLINE_S, PROTOCOL, TRIES, Simulator, join

SUPERCOIL = os.environ["SUPERCOIL"]
QUICK = pathlib.Path(__file__).resolve().parents[1] / "python" / "quick.toml"
# What a busy machine does to any master in real time: a command expires, the lease ends, a knot or an answer is late.
STARVED = ("the board stopped it", "no_lease", "no answer from node", "busy", "not_ready", "ran dry", "has not started",
           "received another command", "wrong_counter", "wrong_state")
TRACKING, TRAJECTORY, SYNC, KNOT = (PROTOCOL.get_message_by_name(name)
                                    for name in ("Tracking", "Trajectory", "Sync", "Knot"))
PLAYING, ENDED = 3, 4  # of Trajectory.playback
TO_PLAY = 2  # of Trajectory.answers


class Recorder(threading.Thread):
    """References of both nodes by time, until it is ended."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.bus = join(port)
        self.references = {1: [], 2: []}
        self.stopping = False

    def run(self):
        while not self.stopping:
            frame = self.bus.recv(0.1)
            node = frame.arbitration_id - TRACKING.frame_id + 1 if frame else 0
            if node in self.references:
                reference_m = TRACKING.decode(frame.data, decode_choices=False)["reference_m"]
                if abs(reference_m) < 0.5:
                    self.references[node].append((frame.timestamp, reference_m))

    def end(self):
        self.stopping = True
        self.join()
        self.bus.shutdown()
        return {node: np.array(references) for node, references in self.references.items()}


def way(time_s):
    """A way of 1 mm, there and back, in 3 s."""
    return 0.0005 * (1.0 - np.cos(2.0 * np.pi * time_s / 3.0))


def motion(folder, of_nodes, step_s=0.02):
    times = np.arange(0.0, 3.0 + step_s / 2.0, step_s)
    path = pathlib.Path(folder) / "motion.csv"
    columns = ",".join(f"{node}:position_m" for node in of_nodes)
    scales = list(of_nodes.values())
    rows = [",".join([f"{t:.3f}", *(f"{0.003 + scale * way(t):.7f}" for scale in scales)]) for t in times]
    path.write_text("\n".join([f"time_s,{columns}", *rows]) + "\n")
    return path


class PlayCase(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def supercoil(self, *arguments):
        return subprocess.run([SUPERCOIL, *arguments, "--can", self.bus], capture_output=True, text=True,
                              timeout=DEADLINE_S)


class Refused(unittest.TestCase):
    """Refusals by a board's own socket, as supercoil reports them."""

    ANSWERS = {"position": "refused: out_of_range; 0.025 would be obeyed", "muscle": " ".join(["1", *["nan"] * 34, "-0.01", "0.025"]) + "\n",
               "knot": "refused: out_of_range; 0.024 would be obeyed", "playback": "1 empty 100 0 0\n", "position 0.003": "ok"}

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())
        self.answers = dict(self.ANSWERS)  # of several, each but the last is given once
        self.received = []
        self.socket = f"{self.folder}/commands"
        self.listener = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.addCleanup(self.listener.close)
        self.listener.bind(self.socket)
        self.listener.listen()
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self):
        while True:
            try:
                client, _ = self.listener.accept()
            except OSError:
                return
            with client:
                while line := client.recv(200).decode().removeprefix("1 "):
                    self.received.append(line)
                    known = self.answers.get(line, self.answers.get(line.split()[0], "ok"))
                    if isinstance(known, list):
                        known = known.pop(0) if len(known) > 1 else known[0]
                    client.send(known.encode())

    def program(self, *arguments):
        done = subprocess.run([SUPERCOIL, *arguments, "--socket", self.socket], capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertEqual(done.returncode, 1)
        return done

    def error_of(self, *arguments):
        return self.program(*arguments).stderr

    def test_a_refused_knot_names_the_nearest_accepted_value(self):
        path = motion(self.folder, {1: 1.0})
        self.assertIn("refused: out_of_range; 0.024 would be obeyed", self.error_of("play", path, "--settle", "0"))

    def test_a_comparison_that_ends_early_rests_before_it_looks_for_a_fault(self):
        self.answers["status"] = "1 active none -\n"
        done = subprocess.run([SUPERCOIL, "doctor", "--compare-senses", "--power", "0.2", "--config", f"{self.folder}/none.toml",
                               "--socket", self.socket], input="", capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertEqual((done.returncode, done.stderr), (1, "supercoil: no answer: the input has ended\n"))
        words = [line.split()[0] for line in self.received]
        after_heat = len(words) - words[::-1].index("power")
        self.assertEqual(words[after_heat:after_heat + 2], ["rest", "status"])

    def test_a_refused_position_names_the_whole_range(self):
        self.assertEqual(self.error_of("command", "1", "position", "0.9"), "supercoil: 1 position 0.9: refused: out_of_range; "
                         "0.025 would be obeyed; -0.01 to 0.025 are in range\n")
        self.assertIn("; -0.01 to 0.025 are in range\n", self.error_of("command", "1", "position", "0.9", "--for", "5"))
        answer = json.loads(self.program("command", "1", "position", "0.9", "--json").stdout)
        self.assertEqual(answer["range"], "-0.01 to 0.025 are in range")

    def test_a_sine_that_leaves_the_range_is_not_begun(self):
        sine = ("command", "1", "position", "0.001", "--amplitude", "0.05", "--period", "1", "--for", "4")
        self.assertEqual(self.error_of(*sine), "supercoil: 1 position 0.001 --amplitude 0.05: leaves the range; "
                         "-0.01 to 0.025 are in range\n")
        self.assertEqual(self.received, ["muscle"])
        self.answers |= {"position": "refused: wrong_state"}
        for middle, amplitude in (("0.0075", "0.0175"), ("0.0075", "-0.0175"), ("0.001", "0.002")):
            self.received.clear()
            self.error_of("command", "1", "position", middle, "--amplitude", amplitude, "--period", "1", "--for", "4")
            self.assertEqual([line.split()[0] for line in self.received[:2]], ["muscle", "position"])

    def test_a_muscle_rests_after_a_refusal_of_a_held_set_point(self):
        self.answers |= {"position": ["ok", "ok", "refused: queue_full"]}
        self.assertIn("refused: queue_full", self.error_of("command", "1 position 0.02", "--for", "60"))
        self.assertEqual([line.split()[0] for line in self.received], ["position"] * 3 + ["rest"])
        self.received.clear()
        self.answers |= {"position": "refused: queue_full"}
        self.error_of("command", "1", "position", "0.02", "--for", "60")
        self.assertEqual([line.split()[0] for line in self.received], ["position"])

    def test_a_question_of_a_program_is_not_a_command(self):
        for question in ("status", "muscle", "playback"):
            done = subprocess.run([SUPERCOIL, "command", question, "--socket", self.socket], capture_output=True, text=True, timeout=DEADLINE_S)
            self.assertEqual((done.returncode, done.stdout, done.stderr),
                             (2, "", f"supercoil: '{question}': must be state, or a channel, as in '1 arm'\n"))
        self.assertEqual(self.received, [])

    def test_a_held_set_point_names_the_fault_that_ended_it(self):
        held = ("command", "1", "position", "0.02", "--for", "60")
        fault = f"fault heater_open; see faults/heater_open in `supercoil docs`; when its cause is gone: supercoil command 1 reset --socket {self.socket}"
        for options in (), ("--json",):
            self.answers |= {"position": ["ok", "ok", "refused: wrong_state"], "status": ["1 active none -\n", "1 fault heater_open -\n"]}
            done = self.program(*held, *options)
            self.assertEqual(done.stderr, f"supercoil: 1 position 0.02: {fault}\n")
        self.assertEqual(json.loads(done.stdout), {"command": "1 position 0.02", "answer": "refused: wrong_state", "cause": fault})
        # For a channel without a fault no cause is made up.
        self.answers |= {"position": "refused: wrong_state", "status": "1 disarmed none -\n"}
        self.assertIn("refused: wrong_state: arm it first", self.error_of(*held))


class Files(PlayCase):
    bus = "socketcand:1"

    def test_errors_name_the_line_and_nothing_is_sent(self):
        path = pathlib.Path(self.folder) / "wrong.csv"
        for text, why in (
                ("", "is empty"),
                ("time_s\n0\n", "1: has no column position_m"),
                ("position_m\n0\n", "1: has no column time_s"),
                ("time_s,position\n0,0\n", "1: 'position' is not a known column; expected time_s, position_m"),
                ("time_s,64:position_m\n0,0\n", "1: '64:position_m': a node must be 1 to 63"),
                ("time_s,2x:position_m\n0,0\n", "1: '2x:position_m': a node must be 1 to 63"),
                ("time_s,2:velocity_m_per_s\n0,0\n", "1: has no position_m of node 2"),
                ("time_s,position_m,1:position_m\n0,0,0\n", "1: has '1:position_m' twice"),
                ("time_s,position_m\n0,0\n", "has fewer than 2 rows"),
                ("time_s,position_m\n0,0\n1\n", "3: has 1 fields; there are 2 columns"),
                ("time_s,position_m\n0,0\n1,nan\n", '3: "nan" is not a number'),
                ("time_s,position_m\n0,0\n1,1 mm\n", '3: "1 mm" is not a number'),
                ("time_s,position_m\n0,0\n\n5,0.001\n",
                 "4: time_s is 5 s after the row before; it must be 0.001 to 4.094 s"),
                ("time_s,position_m\n1,0\n1,0.001\n", "3: time_s is 0 s after the row before"),
                ("time_s,position_m\n0,0\n0.0005,0\n0.001,0.001\n", "3: time_s is 0.0005 s after the row before"),
                ("time_s,position_m,velocity_m_per_s\n0,0,0\n1,0.001,0.1\n",
                 "wrong.csv:3: node 1: velocity_m_per_s of the last row must be 0"),
                ("time_s,position_m,velocity_m_per_s\n# begins\n0,0,0.1\n1,0.001,0\n",
                 "wrong.csv:3: node 1: velocity_m_per_s of the first row must be 0"),
                ("time_s,position_m,velocity_m_per_s\n0,0,0\n1,0.1,0.4\n2,0.1,0\n",
                 "wrong.csv:3: node 1: at 1 s it moves by 0.4 m/s; at most 0.32767 can be sent")):
            path.write_text(text)
            done = self.supercoil("play", path)
            self.assertEqual((done.returncode, done.stdout), (2, ""), text)
            self.assertIn(f"{path}", done.stderr)
            self.assertIn(why, done.stderr)

    def test_spreadsheet_format_is_accepted(self):
        path = pathlib.Path(self.folder) / "sheet.csv"
        path.write_text("\ufeff# taken by hand\n\"time_s\";\"position_m\"\n0,0;0,003\n0,5;0,0031\n")
        self.assertIn("socketcand", self.supercoil("play", path).stderr)  # the file is right, and nobody serves the bus

    def test_a_missing_file_or_bus_is_named(self):
        done = self.supercoil("play", "not-there.csv")
        self.assertEqual(done.returncode, 2)
        self.assertIn("not-there.csv: there is no such file", done.stderr)
        done = self.supercoil("play", motion(self.folder, {1: 1.0}), "--json")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("socketcand", done.stderr)
        self.assertIn("socketcand", json.loads(done.stdout)["error"])
        done = self.supercoil("play", "not-there.csv", "--json")
        self.assertEqual(json.loads(done.stdout), {"error": "not-there.csv: there is no such file"})


class Play(PlayCase):
    def setUp(self):
        super().setUp()
        self.simulator = Simulator(self.folder, QUICK, "--nodes", "2")
        self.addCleanup(self.simulator.end)
        self.bus = f"socketcand:{self.simulator.port}"

    def arm(self):
        for node in ("1", "2"):
            self.supercoil("command", node, "reset")
            self.supercoil("command", node, "disarm")
            end = time.monotonic() + DEADLINE_S
            while self.supercoil("command", node, "arm").returncode:
                self.assertLess(time.monotonic(), end)

    def play(self, *arguments, wanted=None):
        """Repeats when the machine was too busy for a motion in real time, unless it says what is wanted."""
        for _ in range(TRIES):
            self.arm()
            done = self.supercoil("play", *arguments)
            if (wanted and wanted in done.stderr) or not any(why in done.stderr for why in STARVED):
                return done
        self.fail(f"the machine is too busy: {done.stderr}")

    def pass_through(self, **alter):
        """From now on the bus is one on which frames are lost or altered."""
        between = Between(self.simulator.port, **alter)
        self.addCleanup(between.end)
        self.bus = f"socketcand:{between.port}"

    def test_two_nodes_move_in_step(self):
        recorder = Recorder(self.simulator.port)
        recorder.start()
        done = self.play(motion(self.folder, {1: 1.0, 2: 0.5}), "--json")
        references = recorder.end()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout), {"played": True})
        # The last play's: it ends with the references.
        ways = {}
        for node, scale in ((1, 1.0), (2, 0.5)):
            times, references_m = references[node].T
            last = times > times[-1] - 2.9
            ways[node] = times[last], (references_m[last] - 0.003) / scale
        times, first = ways[1]
        second = np.interp(times, *ways[2])
        self.assertGreater(np.ptp(first), 0.0009)
        # A tick is 10 ms, in which the reference moves 10 um at most.
        np.testing.assert_allclose(first, second, atol=3e-5)

    def test_an_infeasible_knot_is_refused_with_its_time(self):
        path = pathlib.Path(self.folder) / "fast.csv"
        path.write_text("time_s,position_m\n0,0.002\n1,0.0022\n1.2,0.02\n1.4,0.02\n")
        done = self.play(path, "--settle", "0.5")
        self.assertEqual(done.returncode, 1)
        self.assertIn("node 1: the knot at 1.000 s: refused: infeasible", done.stderr)

    def test_ends_when_no_sync_arrives(self):
        self.pass_through(to_board=lambda identifier, data: None if identifier == SYNC.frame_id else data)
        not_started = "node 1: has not started: no Sync arrived, or too late"
        done = self.play(motion(self.folder, {1: 1.0}), "--settle", "0.1", wanted=not_started)
        self.assertEqual(done.returncode, 1)
        self.assertIn(not_started, done.stderr)

    def test_a_rest_in_the_middle_does_not_end_it(self):
        path = pathlib.Path(self.folder) / "rests.csv"
        path.write_text("time_s,position_m,velocity_m_per_s\n0,0.003,0\n1,0.0032,0\n2,0.0034,0\n")
        first = b"\x00\x00"  # after_s, behind the counter
        knots = []

        def count(identifier, data):
            if identifier == KNOT.frame_id:
                begins = bytes((data[1] >> 4, data[2])) == first
                knots[:] = [data] if begins else [*knots, data]
            return data

        def hide(room_once_at_rest):
            """Hides that there is room for the third, until the muscle is at rest or for good."""
            def change(identifier, data):
                state = TRAJECTORY.decode(data, decode_choices=False) if identifier == TRAJECTORY.frame_id else None
                if state is None or len(knots) < 2:
                    return data
                if room_once_at_rest and state["playback"] == ENDED:
                    if state["answers"] == TO_PLAY:  # it learns of the end only from the next knot's answer
                        state["playback"] = PLAYING
                else:
                    state["room"] = 0
                return e2e.protected(identifier, TRAJECTORY.encode(state))
            return change
        dry = "node 1: ran dry: the knot after the one at 1.000 s came too late"
        for room_once_at_rest, sent in ((False, 2), (True, 3)):
            with self.subTest(sent=sent):
                self.pass_through(to_board=count, from_board=hide(room_once_at_rest))
                done = self.play(path, "--settle", "0.1", wanted=dry)
                self.assertEqual(done.returncode, 1)
                self.assertIn(dry, done.stderr)
                self.assertEqual(len(knots), sent)

    def test_muscles_must_be_armed(self):
        for _ in range(TRIES):
            done = self.supercoil("play", motion(self.folder, {1: 1.0}))
            if "no answer" not in done.stderr:
                break
        self.assertEqual(done.returncode, 1)
        self.assertIn("node 1: position 0.003000: refused: wrong_state", done.stderr)

    def test_muscles_cool_after_the_player_is_killed(self):
        for _ in range(TRIES):
            self.arm()
            process = subprocess.Popen([SUPERCOIL, "play", motion(self.folder, {1: 1.0, 2: 1.0}), "--settle", "1",
                                        "--can", self.bus], stderr=subprocess.PIPE, text=True)
            self.addCleanup(process.communicate)
            self.addCleanup(process.kill)
            time.sleep(2.5)
            played = process.poll() is None  # otherwise the machine was too busy for it
            process.send_signal(signal.SIGKILL)
            if played:
                break
        self.assertTrue(played)
        end = time.monotonic() + DEADLINE_S
        while "command_timeout" not in self.supercoil("command", "state").stdout:
            self.assertLess(time.monotonic(), end)


if __name__ == "__main__":
    unittest.main()
