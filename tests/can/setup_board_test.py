"""supercoil setup of a board that runs: it is calibrated, identified and tuned in real time."""

import json
import re
import signal
import subprocess
import time
import tomllib
import unittest

from live import DEADLINE_S, TRIES, Simulator
from setup_case import EXAMPLE, RESTART, STARVED, SUPERCOIL, SetupCase, Terminal


class SetupOnABoard(SetupCase):
    def test_a_stopped_board_is_reported_with_how_to_start_it(self):
        done = self.setup_program("calibrate", "--socket", self.path / "none")
        self.assertEqual(done.returncode, 1)
        self.assertIn("start the board with", done.stderr)
        done = self.setup_program("identify", "--channel", "3")
        self.assertEqual(done.returncode, 2)
        self.assertIn("has no channel 3, but 2", done.stderr)

    def test_a_board_with_another_file_is_not_touched(self):
        self.describe()
        simulator = Simulator(self.path, "bench")  # with a different muscle
        self.addCleanup(simulator.end)
        bus = f"socketcand:{simulator.port}"
        start = f"supercoil-sim run bench --board {self.board} --real-time --learned learned --can {bus}"
        self.record.write_text("{}")  # everything but the file is to be done

        def command(*words):
            return subprocess.run([SUPERCOIL, "command", *words, "--can", bus], capture_output=True, text=True, timeout=DEADLINE_S)

        end_s = time.monotonic() + DEADLINE_S
        while "node 1: armed" not in command("state").stdout:  # by somebody else, whose muscle it is
            self.assertLess(time.monotonic(), end_s)
            command("1", "arm")
        for step in ("senses", "calibrate", "scale", "limits", "identify", "gains", "move"):
            done = self.setup_program(step, "--can", bus, input="5\n")
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"supercoil: {step}: {self.board}: the board is not running with this file: channel 1: muscle.", done.stderr)
            self.assertRegex(done.stderr, r"muscle\.stiffness_N_per_m = 17\.84 \(the board: [\d.]+\), .*limits\.max_travel_m = 0\.025 \(the board: 0\.0\d+\)")
            self.assertIn(start, done.stderr)
        self.assertEqual(self.record.read_text(), "{}")
        output = command("state").stdout
        self.assertIn("node 1: armed, rest", output)
        self.assertNotIn("last identification or calibration", output)  # it was given nothing to do

    def test_steps_missing_on_the_board_count_as_undone(self):
        self.describe()
        simulator = Simulator(self.path, "bench", "--board", self.board)
        self.addCleanup(simulator.end)
        bus = ("--can", f"socketcand:{simulator.port}")
        record = json.loads(self.record.read_text())
        described = tomllib.loads(self.board.read_text())["channel"][0]["muscle"]
        steps = {"describe": record["channel-1"]["describe"], "senses": {},
                 "calibrate": {"position_offset_m": 0.0, "cold_resistance_Ohm": 10.0}, "limits": {},
                 "identify": {**described, "unexplained_ratio": 0.001}, "gains": {}, "move": {}}

        def remember(**changes):
            self.record.write_text(json.dumps(record | {"channel-1": {**steps, **changes}}))

        remember()
        done = self.patiently(lambda: self.setup_program(*bus))
        self.assertEqual(done.stdout, "every step is done; name one to do it again\n")
        remember(identify={**described, "stiffness_N_per_m": 1.001 * described["stiffness_N_per_m"]})
        lines = self.interrupted_at("identify: heats", *bus)
        self.assertEqual(len(lines), 2, lines)
        self.assertRegex(lines[0], r"^  identify and all later steps must be repeated: the board uses stiffness_N_per_m = 17\.84, "
                         r"and \S+board\.toml\.setup\.json has 17\.858: it is another board or muscle")
        remember(calibrate={"position_offset_m": 0.0002, "cold_resistance_Ohm": 10.0})
        lines = self.interrupted_at("calibrate: takes", *bus)
        self.assertIn("calibrate and all later steps must be repeated: the board uses position_offset_m = 0, ", lines[0])
        self.assertEqual(len(lines), 2, lines)  # neither describe nor senses again
        self.assertIn("identify", json.loads(self.record.read_text())["channel-1"])  # the other board may come back
        done = self.setup_program("--socket", self.path / "none")
        self.assertEqual(done.returncode, 1)
        self.assertIn("start the board with", done.stderr)

    def interrupted_at(self, line, *arguments):
        """The lines up to one that begins with `line`; then ends the program."""
        lines = []
        with subprocess.Popen([SUPERCOIL, "setup", "--config", self.board, *arguments], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
            for text in program.stdout:
                lines.append(text)
                if text.startswith(line):
                    break
            program.send_signal(signal.SIGINT)
            _, error = program.communicate(timeout=DEADLINE_S)
        self.assertTrue(lines and lines[-1].startswith(line), f"{lines} {error}")
        return lines

    def test_continues_after_completed_steps_and_interruptions(self):
        self.describe()
        learned = self.path / "learned"
        learned.mkdir()
        simulator = Simulator(self.path, "bench", "--board", self.board, "--learned", learned)
        self.addCleanup(simulator.end)
        bus = f"socketcand:{simulator.port}"
        for _ in range(TRIES):
            subprocess.run([SUPERCOIL, "command", "1", "reset", "--can", bus], capture_output=True, timeout=DEADLINE_S)
            done = self.setup_program("calibrate", "--can", bus, "--json")
            if not any(why in done.stderr for why in STARVED):
                break
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)["steps"]["calibrate"]
        self.assertAlmostEqual(found["cold_resistance_Ohm"], 10.0, delta=0.05)
        self.assertAlmostEqual(found["position_offset_m"], 0.0, delta=1e-4)
        state = subprocess.run([SUPERCOIL, "command", "state", "--can", bus], capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertRegex(state.stdout, "node 1: disarmed")
        # The muscle hangs at its zero: no scale turns that into 5 mm.
        done = self.setup_program("scale", "--can", bus, input="5\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("in the direction of contraction, in mm (0.025 to 25): ", done.stdout)
        self.assertIn("supercoil: scale 0.005: refused: out_of_range", done.stderr)
        simulator.end(signal.SIGKILL)
        simulator = Simulator(self.path, "bench", "--board", self.board, "--learned", learned)
        self.addCleanup(simulator.end)
        bus = f"socketcand:{simulator.port}"
        with subprocess.Popen([SUPERCOIL, "setup", "--config", self.board, "--can", bus], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
            lines = [program.stdout.readline() for _ in range(5)]
            self.assertTrue(lines[0].startswith("scale: takes"))
            self.assertIn(f"skipped; supercoil setup scale --config {self.board} --can {bus} does it", lines[1])
            self.assertTrue(lines[2].startswith("limits: finds"))
            self.assertIn(f"skipped; supercoil setup limits --config {self.board} --can {bus} does it", lines[3])
            self.assertTrue(lines[4].startswith("identify: heats"))
            time.sleep(0.5)
            program.send_signal(signal.SIGINT)
            _, error = program.communicate(timeout=DEADLINE_S)
        self.assertEqual(program.returncode, 1)
        self.assertIn("identify: ", error)
        self.assertEqual(set(json.loads(self.record.read_text())["channel-1"]), {"describe", "calibrate"})

    def test_the_fault_of_a_killed_master_is_reset_on_confirmation(self):
        self.describe()
        simulator = Simulator(self.path, "bench", "--board", self.board)
        self.addCleanup(simulator.end)
        bus = ("--can", f"socketcand:{simulator.port}")

        def command(*words):
            return subprocess.run([SUPERCOIL, "command", *words, *bus], capture_output=True, text=True, timeout=DEADLINE_S)

        def until(text, *words):
            end_s = time.monotonic() + DEADLINE_S
            while text not in command("state").stdout:
                self.assertLess(time.monotonic(), end_s)
                for word in words:
                    command("1", word)

        until("node 1: armed", "arm")
        with subprocess.Popen([SUPERCOIL, "command", "1", "power", "0.05", "--hold", *bus], stderr=subprocess.DEVNULL) as heats:
            time.sleep(1.0)
            heats.kill()
        until("FAULT command_timeout")
        fault_text = f"fault command_timeout; see faults/command_timeout in `supercoil docs`; when its cause is gone: supercoil command 1 reset {' '.join(bus)}\n"
        done = self.setup_program("calibrate", *bus, stdin=subprocess.DEVNULL)
        self.assertEqual((done.returncode, done.stderr), (1, f"supercoil: calibrate: cannot be armed: {fault_text}"))
        self.assertIn("FAULT command_timeout", command("state").stdout)
        done = self.setup_program("calibrate", *bus, *self.script(), stdin=subprocess.DEVNULL)
        self.assertEqual((done.returncode, done.stderr), (1, f"supercoil: calibrate: cannot be armed: {fault_text}"))
        done = self.patiently(lambda: self.setup_program("calibrate", *bus, *self.script(reset_fault=1), stdin=subprocess.DEVNULL))
        self.assertIn(f"  channel 1: {fault_text}", done.stdout)
        self.assertIn("  1: its cause is gone, reset the fault; 0: leave it: 1\n", done.stdout)

    def test_on_a_terminal_an_interruption_has_its_own_line(self):
        self.describe()
        simulator = Simulator(self.path, "bench", "--board", self.board)
        self.addCleanup(simulator.end)
        bus = ("--can", f"socketcand:{simulator.port}")

        def command(*words):
            return subprocess.run([SUPERCOIL, "command", "1", *words, *bus], capture_output=True, timeout=DEADLINE_S)

        def interrupted(shown, *arguments, program="setup"):
            for _ in range(TRIES):
                command("reset")
                if program == "command":
                    command("arm")
                with Terminal(*arguments, *bus, command=program) as terminal:
                    # This tests what is shown, not whether a busy machine renews in time.
                    def starved(terminal=terminal):
                        return any(why in terminal.output for why in (*STARVED, "command_timeout"))

                    try:
                        terminal.until(shown)
                    except AssertionError:
                        if not starved():
                            raise
                        continue
                    terminal.type("\x03")
                    terminal.ended()
                    if not starved():
                        return terminal.output
            raise AssertionError(terminal.output)

        config = ("--config", self.board)
        self.assertRegex(interrupted(r"volts at the supply terminals \S+ to \S+: $", "senses", *config),
                         r": \^C\r\nsupercoil: senses: interrupted\r\n$")
        self.assertRegex(interrupted("channel 1 gets .* W", "senses", *config), r"\n\^C\r\nsupercoil: senses: interrupted\r\n$")
        for shown in (r"identify: \d+ %", "takes about .*\n"):  # with progress, and before it
            self.assertRegex(interrupted(shown, "identify", *config), r"\^C\r\n(\r\x1b\[K)?supercoil: identify: interrupted\r\n$")
        output = interrupted(r"1 identify: \d+ %", "1", "identify", "--hold", program="command")
        self.assertRegex(output, r"\^C\r\n(\r\x1b\[K)?supercoil: 1 identify ended: interrupted, by Ctrl-C\r\n$")
        output = interrupted("1 position 0.001:", "1", "position", "0.001", "--hold", program="command")
        self.assertRegex(output, r"\^C\r\n(\r\x1b\[K)?$")

    def test_the_recommended_controller_is_applied_on_confirmation(self):
        self.describe()
        simulator = Simulator(self.path, "bench", "--board", self.board)
        self.addCleanup(simulator.end)
        bus = ("--can", f"socketcand:{simulator.port}")

        def bandwidth(*change):
            done = self.patiently(lambda: subprocess.run([SUPERCOIL, "tune", "1", *change, "--json", *bus], capture_output=True,
                                                         text=True, timeout=DEADLINE_S))
            bandwidths = json.loads(done.stdout)["controllers"][0]["bandwidth_rad_per_s"]
            return round(bandwidths["in_use"], 2), round(bandwidths["stored"], 2)

        def gains(expected, *arguments, **options):
            done = self.patiently(lambda: self.setup_program("gains", *bus, *arguments, **options))
            self.assertIn(expected, done.stdout)
            return done.stdout

        slow = ("bandwidth_rad_per_s=3", "--store")
        self.assertEqual(bandwidth(*slow), (3.0, 3.0))
        output = gains("kept as it is", stdin=subprocess.DEVNULL)
        self.assertRegex(output, r"in use: controller 0, learned_ff: bandwidth_rad_per_s = 3, .*reference_model = poles, model_pole_1_rad_per_s = 3\.\d+, ")
        self.assertRegex(output, r"with it: margin 0\.\d+, holds if no parameter is off by more than \d+ %, bandwidth 3 rad/s; promises at most \d+")
        self.assertRegex(output, r"recommended for this muscle: .*bandwidth_rad_per_s = 7\.8\d+ }: .*, 1\.88 s, in units of")
        self.assertRegex(output, r"with reference_model = \{ kind = \"poles\", poles_rad_per_s = \[\d\.\d+, .*falls from 90 to 10 % in 4\.\d+ s by itself")
        self.assertIn("keep the one in use (0 to 1) [1]: ", output)
        gains("kept as it is", *self.script(take_gains=0))
        self.assertEqual(bandwidth(), (3.0, 3.0))
        gains("taken over, and stored", *self.script())
        self.assertEqual(bandwidth(), (7.88, 7.88))
        gains("it is in use already: nothing changes", stdin=subprocess.DEVNULL)
        bandwidth(*slow)
        gains("taken over, and stored", input="1\n")
        self.assertEqual(bandwidth(), (7.88, 7.88))
        self.assertEqual(set(json.loads(self.record.read_text())["channel-1"]), {"describe", "gains"})

    def test_an_answered_limit_is_written_to_the_board_file(self):
        self.describe()
        before = self.board.read_text()
        self.assertIn("max_travel_m = 0.025", before)
        simulator = Simulator(self.path, "bench", "--board", self.board)
        self.addCleanup(simulator.end)
        bus = f"socketcand:{simulator.port}"

        def answer_at_4_mm():
            subprocess.run([SUPERCOIL, "command", "1", "reset", "--can", bus], capture_output=True, timeout=DEADLINE_S)
            with subprocess.Popen([SUPERCOIL, "setup", "limits", "--config", self.board, "--can", bus], stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
                for line in program.stdout:
                    position = re.search(r"([\d.]+) mm at [\d.]+ W", line)
                    if position and float(position[1]) > 4.0:
                        break
                output, error = program.communicate("1\n", timeout=DEADLINE_S)
            return program.returncode, output, error

        for _ in range(TRIES):
            status, output, error = answer_at_4_mm()
            if not any(why in error for why in STARVED):
                break
        self.assertEqual(status, 0, error)
        limit = re.search(r"limit: ([\d.]+) mm \(configured: 25 mm\)", output)
        self.assertGreater(float(limit[1]), 3.5)
        written = f"max_travel_m = {1e-3 * float(limit[1]):.4g}"
        self.assertIn(written, self.board.read_text())
        self.assertEqual(self.board.read_text().replace(written, "max_travel_m = 0.025"), before)
        self.assertEqual((self.path / "board.toml.before-setup").read_text(), self.example)
        self.assertEqual(set(json.loads(self.record.read_text())["channel-1"]), {"describe", "limits"})
        state = subprocess.run([SUPERCOIL, "command", "state", "--can", bus], capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertRegex(state.stdout, "node 1: disarmed")

    def test_a_script_replaces_all_answers(self):
        power_W, supply_V = 0.1, 12.0
        script = self.script("[senses]", f"power_W = {power_W}", f"supply_V = [{supply_V}, {supply_V}]",
                             f"current_A = [{0.5 * power_W / supply_V}, {power_W / supply_V}]", "[limits]", "stop_mm = 4")
        self.describe(*script)
        simulator = Simulator(self.path, "bench", "--board", self.board)
        self.addCleanup(simulator.end)
        bus = ("--can", f"socketcand:{simulator.port}")

        def unattended():
            subprocess.run([SUPERCOIL, "command", "1", "reset", *bus], capture_output=True, timeout=DEADLINE_S)
            return self.setup_program(*script, *bus, stdin=subprocess.DEVNULL)

        output = self.patiently(unattended, RESTART).stdout
        self.assertIn(f"skipped; supercoil setup scale --config {self.board} {' '.join(bus)} does it", output)
        self.assertIn("lets go where the script says", output)
        limit = float(re.search(r"limit: ([\d.]+) mm \(configured: 25 mm\)", output)[1])
        self.assertTrue(3.4 < limit < 4.5, limit)
        self.assertIn(f"max_travel_m = {1e-3 * limit:.4g}", self.board.read_text())
        record = json.loads(self.record.read_text())["channel-1"]
        self.assertEqual(set(record), {"describe", "doctor", "senses", "calibrate", "limits"})
        self.assertEqual(record["senses"]["power_W"], power_W)
        self.assertAlmostEqual(record["senses"]["supply_gain"], 1.0, delta=0.02)

    def test_a_joint_is_set_up_through_its_agonist(self):
        self.example = (EXAMPLE.parent / "joint-as5600-ads1115.toml").read_text()
        self.board.write_text(self.example)
        script = self.script(heated_mm=6.5, stretch_mm=30, max_travel_mm=8)
        for channel in ("1", "2"):
            done = self.setup_program("describe", "--channel", channel, *script)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("it turns a joint: answer for this muscle moving the joint alone", done.stdout)
            self.assertIn("Hang weights at the lever, 15 mm from the axis", done.stdout)
        self.board.write_text(self.example.replace("lever_m = 0.015", "lever_m = [0.012, 0.016, 0.012]\nlever_range_deg = [-40, 40]"))
        done = self.setup_program("describe", "--channel", "1", *script)
        self.assertIn("Hang weights at the lever, 16 mm from the axis", done.stdout)
        self.board.write_text(self.example)
        for step, channel, expected in (("move", "2", "channel 2 is a joint's antagonist: set up its agonist instead, --channel 1"),
                                    ("scale", "1", "channel 1 turns a joint: the file's m_per_count and lever_m are its scale"),
                                    ("move", "1", "start the board with")):
            done = self.setup_program(step, "--channel", channel, "--socket", self.path / "none")
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"{step}: ", done.stderr)
            self.assertIn(expected, done.stderr)
        record = json.loads(self.record.read_text())
        self.record.write_text(json.dumps(record | {"channel-2": record["channel-2"] | {"identify": {}}}))
        done = self.setup_program("--channel", "2", "--socket", self.path / "none")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(re.findall(r"^(\w+): channel 2 is a joint's antagonist", done.stdout, re.M), ["gains", "move"])
        self.assertNotIn("every step is done", done.stdout)
        self.record.write_text(json.dumps(record))
        simulator = Simulator(self.path, "joint-bench", "--board", self.board)
        self.addCleanup(simulator.end)
        bus = ("--can", f"socketcand:{simulator.port}")

        def calibrated():
            subprocess.run([SUPERCOIL, "command", "1", "reset", *bus], capture_output=True, timeout=DEADLINE_S)
            return self.setup_program("calibrate", *bus)

        self.assertRegex(self.patiently(calibrated).stdout, r"(?s)the agonist, channel 1:.*cold resistance: 10 Ohm .*"
                         r"the antagonist, channel 2:.*cold resistance: 10 Ohm ")
        done_steps = json.loads(self.record.read_text())
        self.assertEqual([set(done_steps[f"channel-{number}"]) for number in (1, 2)], 2 * [{"describe", "calibrate"}])
        state = subprocess.run([SUPERCOIL, "command", "state", *bus], capture_output=True, text=True, timeout=DEADLINE_S).stdout
        self.assertEqual(re.findall(r"node (\d): disarmed", state), ["1", "2"])

        def command(*words):
            return subprocess.run([SUPERCOIL, "command", "1", *words, *bus], capture_output=True, text=True, timeout=DEADLINE_S)

        def positioned(angle):
            for _ in range(TRIES):
                command("arm")
                done = command("position", angle)
                if not any(why in done.stderr for why in STARVED):
                    break
            return done

        refusal = re.search(r"refused: out_of_range; 0\.008\d* would be obeyed \((30\.\d+deg)\); -30\.\d+deg to \1 are in range\n", positioned("80deg").stderr)
        self.assertEqual(positioned(refusal[1]).returncode, 0)  # to the digit

if __name__ == "__main__":
    unittest.main()
