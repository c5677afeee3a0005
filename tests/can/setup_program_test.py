"""supercoil setup as a newcomer meets it: a file that is completed, a board in real time that is calibrated, errors."""

import fcntl
import json
import os
import pathlib
import pty
import re
import select
import signal
import subprocess
import tempfile
import termios
import time
import tomllib
import unittest

from live import DEADLINE_S, TRIES, Simulator

SUPERCOIL = os.environ["SUPERCOIL"]
SUPERCOILD = os.environ["SUPERCOILD"]
EXAMPLE = pathlib.Path(os.environ["SUPERCOIL_EXAMPLES"]) / "raspberry-pi-pwm-ads1115.toml"
ANSWERS = {"cold_resistance_Ohm": 10, "load_g": 90, "stretch_weight_g": 100, "stretch_mm": 55, "heated_W": 2.0,
           "heated_mm": 13, "half_cooling_s": 1.3, "thread_g": 0.1, "max_W": 4.5, "max_travel_mm": 25,
           "uncertainty_percent": 30}
# What a busy machine does to any master in real time.
STARVED = ("wrong_state", "no_lease", "no answer from node", "busy", "not_ready")


class Terminal:
    """supercoil setup on a terminal of its own; what it tells is one text, as somebody sees it come."""

    def __init__(self, *arguments):
        terminal, self.end = pty.openpty()
        self.file = terminal
        self.told = ""
        self.answers = 0
        self.program = subprocess.Popen([SUPERCOIL, "setup", *arguments], stdin=self.end, stdout=self.end, stderr=self.end,
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
                self.told += os.read(self.file, 65536).decode()
            return True
        except OSError:
            return False

    def until(self, text, patience_s=DEADLINE_S):
        """text: also that of a regular expression."""
        end_s = time.monotonic() + patience_s
        while not re.search(text, self.told):
            if not self.read() or time.monotonic() > end_s:
                raise AssertionError(f"no {text!r} in {self.told!r}")

    def type(self, text):
        os.write(self.file, text.encode())

    def answer(self, text):
        """Of the question that comes after those that were answered."""
        self.answers += 1
        self.until(r"(?s)([)\]]: .*){%d}$" % self.answers)
        self.type(text + "\n")

    def ended(self):
        while self.read():
            pass
        return self.program.wait(timeout=DEADLINE_S)


class SetupProgram(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        self.board = self.path / "board.toml"
        # Room for a muscle that rests lower in the coldest air than where its zero was taken.
        self.example = EXAMPLE.read_text().replace("min_m = -0.001", "min_m = -0.012")
        self.board.write_text(self.example)
        self.record = self.path / "board.toml.setup.json"

    def setup_program(self, *arguments, **options):
        return subprocess.run([SUPERCOIL, "setup", "--config", self.board, *arguments], capture_output=True, text=True,
                              timeout=DEADLINE_S, **options)

    def patiently(self, run):
        """Again while this program was kept from the processor for so long that its lease ended."""
        for _ in range(TRIES):
            done = run()
            if done.returncode == 0 or not any(why in done.stderr for why in STARVED):
                break
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def script(self, **changes):
        answers = {key: value for key, value in {**ANSWERS, **changes}.items() if value is not None}
        path = self.path / "answers.toml"
        path.write_text("[muscle]\n" + "".join(f"{key} = {value}\n" for key, value in answers.items()))
        return "--script", path

    def assert_refused(self, done, *told):
        self.assertEqual(done.returncode, 2, done.stderr)
        for part in told:
            self.assertIn(part, done.stderr)
        self.assertEqual(self.board.read_text(), self.example)
        self.assertFalse(self.record.exists())

    def test_a_description_completes_the_boards_file_and_keeps_its_comments(self):
        done = self.setup_program(*self.script())
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("stiffness_N_per_m = 17.84  (stretch_weight_g and stretch_mm)", done.stdout)
        self.assertIn("holds ", done.stdout)
        text = self.board.read_text()
        for line in self.example.splitlines():
            self.assertIn(line, text)
        checked = subprocess.run([SUPERCOILD, "--check", self.board], capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("0: learned_ff", checked.stdout)
        self.assertIn("describe", json.loads(self.record.read_text())["channel-1"])
        self.assertEqual((self.path / "board.toml.before-setup").read_text(), self.example)

    def test_asks_what_no_script_answers_and_asks_again_after_a_slip(self):
        lines = [str(value) for value in ANSWERS.values()]
        questions = ["10 Ohm", *lines[:7], "", "22.5", *lines[8:10], ""]  # by a thermometer in place of the weight
        done = self.setup_program("describe", input="\n".join(questions) + "\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Resistance of the cold muscle by an ohmmeter, in Ohm (0.1 to 10000): '10 Ohm' is refused", done.stdout)
        self.assertIn("wrong, in % (1 to 60) [50]: ", done.stdout)
        self.assertIn("max_travel_m = 0.025", done.stdout)

    def test_an_answer_is_refused_where_it_is_asked_and_what_was_answered_is_offered_again(self):
        # By a thermometer, as thread_g is not known: then heated_K must be.
        typed = ["10", "90", "100", "55", "2", "13", "1.3", "0", "", "0", "22.5", "200", "11.7"]
        with Terminal("describe", "--config", self.board) as terminal:
            for text in (*typed, "11.665", "30"):  # four slips for max_W
                terminal.answer(text)
            terminal.until(r"(?s)(11\.664\): .*){5}$")
            self.assertIn("by a thermometer, in K; needed, as thread_g is not known (0.1 to 200): ", terminal.told)
            self.assertEqual(terminal.told.count("'' is refused: it must be a number from 0.1 to 200"), 1)
            self.assertEqual(terminal.told.count("at most what the supply gives it (0.001 to 11.664): "), 5)
            terminal.answer("4.5")
            terminal.until(r"at most what its sensor reads \(0\.01 to 41\): $")
            terminal.type("\x03")
            self.assertEqual(terminal.ended(), 2)
        self.assertTrue(terminal.told.endswith("41): ^C\r\nsupercoil: interrupted\r\n"), terminal.told[-200:])
        self.assertEqual(self.board.read_text(), self.example)
        self.assertEqual(self.setup_program("describe", input="\n" * 10 + "25\n\n").returncode, 0)
        text = self.board.read_text()
        for line in ("cold_resistance_Ohm = 10", "max_W = 4.5", "max_travel_m = 0.025", "stiffness_N_per_m = 17.84"):
            self.assertIn(line, text)
        self.assertEqual(json.loads(self.record.read_text())["answers"]["channel-1"]["heated_K"], 22.5)
        self.assertEqual(self.setup_program("--undo").returncode, 0)
        done = self.setup_program("describe", input="12\n" + "\n" * 11)  # one correction
        self.assertIn("in Ohm (0.1 to 10000) [10]: ", done.stdout)
        self.assertIn("cold_resistance_Ohm = 12", self.board.read_text())

    def test_answers_that_no_muscle_has_are_refused_without_a_line_of_a_file_that_is_none_and_kept(self):
        questions = ["10", "0.1", "1e6", "0.01", "2", "13", "1.3", "0.1", "", "4.5", "25", ""]
        done = self.setup_program("describe", input="\n".join(questions) + "\n")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the answers make a muscle with ", done.stderr)
        self.assertIn("the answers are kept: supercoil setup describe offers them again", done.stdout)
        self.assertEqual(self.board.read_text(), self.example)
        self.assertNotRegex(self.setup_program(*self.script(max_W=40)).stderr, r"board\.toml:\d")

    def test_without_anybody_who_answers_nothing_changes(self):
        self.assert_refused(self.setup_program(stdin=subprocess.DEVNULL), "nobody answers")

    def test_every_wrong_answer_is_named_with_its_range(self):
        self.assert_refused(self.setup_program(*self.script(load_g=None, stretch_mm=None)),
                            "muscle.load_g: is missing: Weight that it lifts", "muscle.stretch_mm: is missing")
        self.assert_refused(self.setup_program(*self.script(load_g=0)), "muscle.load_g = 0", "0.1 to 1e+06")
        self.assert_refused(self.setup_program(*self.script(take_gains=2)), "muscle.take_gains = 2", "0 to 1")
        self.assert_refused(self.setup_program(*self.script(lode_g=3)), "muscle.lode_g", "did you mean load_g?")
        self.assert_refused(self.setup_program(*self.script(thread_g=0)), "thread_g or heated_K must be known")
        self.assert_refused(self.setup_program("--script", "missing.toml"), "missing.toml")
        self.assert_refused(self.setup_program("--channel", "3", *self.script()), "there is no channel 3")
        self.assert_refused(self.setup_program("calibrat"), "did you mean calibrate?")

    def test_a_muscle_that_this_board_cannot_have_is_refused_by_its_key(self):
        self.assert_refused(self.setup_program(*self.script(max_W=40)),
                            "channel[1].limits.max_W = 40", "min_V²/cold_resistance_Ohm = 11.664 W")

    def test_a_list_of_controllers_stays_as_it_was_chosen(self):
        self.board.write_text((EXAMPLE.parent / "on-chip-pwm-fast-converter.toml").read_text())
        done = self.setup_program(*self.script())
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        text = self.board.read_text()
        self.assertIn('kind = "mrac"', text)
        self.assertNotIn("learned_ff", text)
        self.assertIn("limits = { max_W = 4.5, max_travel_m = 0.025, energy_J = 200.0 }", text)

    def test_a_file_that_is_none_is_told_before_anything_is_asked(self):
        self.board.write_text("[[channel\n")
        done = self.setup_program(stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 2)
        self.assertIn("board.toml:1: ", done.stderr)
        self.assertNotIn("Resistance", done.stdout)

    def files(self):
        return sorted(path.name.removeprefix("board.toml") for path in self.path.glob("board.toml*"))

    def test_undo_puts_the_file_back_says_so_and_keeps_what_it_replaces(self):
        self.setup_program(*self.script())
        described = self.board.read_text()
        self.assertNotEqual(described, self.example)
        done = self.setup_program("--undo")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, f"{self.board} is as it was before describe of channel 1, and that step and those behind it are "
                         f"to be done; what it was until now is kept as {self.board}.undone\n")
        self.assertEqual(self.board.read_text(), self.example)
        self.assertEqual(self.files(), ["", ".undone"])
        self.assertEqual((self.path / "board.toml.undone").read_text(), described)
        again = self.setup_program("--undo")
        self.assertEqual(again.returncode, 1)
        self.assertIn("setup has changed nothing", again.stderr)

    def test_undo_takes_back_one_change_after_the_other_each_of_its_channel(self):
        self.setup_program(*self.script())
        self.setup_program("describe", *self.script(max_W=3))
        both = self.board.read_text()
        self.assertIn("max_W = 3", both)
        self.setup_program("describe", *self.script(max_W=3))  # changes nothing
        self.setup_program("describe", "--channel", "2", *self.script())
        done = self.setup_program("--undo")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the last change was describe of channel 2: --channel 2 --undo takes that back first", done.stderr)
        self.assertEqual(self.setup_program("--undo", "--channel", "2").returncode, 0)
        self.assertEqual(self.board.read_text(), both)
        done = self.setup_program("--undo", "--json")
        self.assertEqual(json.loads(done.stdout), {"file": str(self.board), "channel": 1, "step": "describe",
                                                   "kept_as": f"{self.board}.undone-2"})
        self.assertIn("max_W = 4.5", self.board.read_text())
        self.setup_program("--undo")
        self.assertEqual(self.board.read_text(), self.example)
        self.assertFalse(self.record.exists())

    def test_undo_does_not_throw_away_what_somebody_else_changed(self):
        self.setup_program(*self.script())
        edited = self.board.read_text() + "# by hand\n"
        self.board.write_text(edited)
        for arguments in ((), ("--json",)):
            done = self.setup_program("--undo", *arguments, stdin=subprocess.DEVNULL)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"{self.board}: was changed after describe of channel 1 wrote it", done.stderr)
            self.assertIn("--undo --force does it", done.stderr)
            self.assertEqual(self.board.read_text(), edited)
        self.assertIn("was changed", json.loads(done.stdout)["error"])
        self.assertEqual(self.files(), ["", ".before-setup", ".setup.json"])
        self.assertEqual(self.setup_program("--undo", "--force").returncode, 0)
        self.assertEqual(self.board.read_text(), self.example)
        self.assertEqual((self.path / "board.toml.undone").read_text(), edited)
        self.assertEqual(self.setup_program("--force").returncode, 2)

    def test_on_a_terminal_undo_asks_about_what_somebody_else_changed(self):
        self.setup_program(*self.script())
        self.board.write_text(self.board.read_text() + "# by hand\n")
        for answer, left in (("0", True), ("1", False)):
            with Terminal("--config", self.board, "--undo") as terminal:
                terminal.until("take it back all the same, 0: leave it")
                terminal.type(answer + "\n")
                self.assertEqual(terminal.ended(), 1 if left else 0, terminal.told)
            self.assertEqual("# by hand" in self.board.read_text(), left)

    def test_without_a_record_of_what_it_wrote_undo_leaves_the_file(self):
        self.setup_program(*self.script())
        described = self.board.read_text()
        self.record.unlink()
        done = self.setup_program("--undo", "--force")
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"{self.board}.before-setup is the file as it was before", done.stderr)
        self.assertEqual(self.board.read_text(), described)

    def test_a_board_that_does_not_run_is_said_with_how_to_start_it(self):
        done = self.setup_program("calibrate", "--socket", self.path / "none")
        self.assertEqual(done.returncode, 1)
        self.assertIn("start the board with", done.stderr)
        done = self.setup_program("identify", "--channel", "3")
        self.assertEqual(done.returncode, 1)
        self.assertIn("has no channel 3, but 2", done.stderr)

    def test_what_another_board_does_not_have_is_not_done(self):
        self.assertEqual(self.setup_program(*self.script()).returncode, 0)
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
        told = self.interrupted_at("identify: heats", *bus)
        self.assertEqual(len(told), 2, told)
        self.assertRegex(told[0], r"^  identify and what follows it are to be done again: the board goes by stiffness_N_per_m = 17\.84, "
                         r"and \S+board\.toml\.setup\.json has 17\.858: it is another board or muscle")
        remember(calibrate={"position_offset_m": 0.0002, "cold_resistance_Ohm": 10.0})
        told = self.interrupted_at("calibrate: takes", *bus)
        self.assertIn("calibrate and what follows it are to be done again: the board goes by position_offset_m = 0, ", told[0])
        self.assertEqual(len(told), 2, told)  # neither describe nor senses again
        self.assertIn("identify", json.loads(self.record.read_text())["channel-1"])  # the other board may come back
        done = self.setup_program("--socket", self.path / "none")
        self.assertEqual(done.returncode, 1)
        self.assertIn("start the board with", done.stderr)

    def interrupted_at(self, line, *arguments):
        """The lines until one begins so; the program is ended then."""
        told = []
        with subprocess.Popen([SUPERCOIL, "setup", "--config", self.board, *arguments], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
            for text in program.stdout:
                told.append(text)
                if text.startswith(line):
                    break
            program.send_signal(signal.SIGINT)
            _, error = program.communicate(timeout=DEADLINE_S)
        self.assertTrue(told and told[-1].startswith(line), f"{told} {error}")
        return told

    def test_on_a_running_board_it_goes_on_after_what_is_done_and_an_interruption_loses_nothing(self):
        self.assertEqual(self.setup_program(*self.script()).returncode, 0)
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
        # It hangs at its zero: no scale makes 5 mm of that.
        done = self.setup_program("scale", "--can", bus, input="5\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("towards shorter, in mm (0.025 to 25): ", done.stdout)
        self.assertIn("supercoil: scale 0.005: refused: out_of_range", done.stderr)
        simulator.end()
        simulator = Simulator(self.path, "bench", "--board", self.board, "--learned", learned)
        self.addCleanup(simulator.end)
        bus = f"socketcand:{simulator.port}"
        with subprocess.Popen([SUPERCOIL, "setup", "--config", self.board, "--can", bus], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
            told = [program.stdout.readline() for _ in range(5)]
            self.assertTrue(told[0].startswith("scale: takes"))
            self.assertIn("left; supercoil setup scale does it", told[1])
            self.assertTrue(told[2].startswith("limits: finds"))
            self.assertIn("left; supercoil setup limits does it", told[3])
            self.assertTrue(told[4].startswith("identify: heats"))
            time.sleep(0.5)
            program.send_signal(signal.SIGINT)
            _, error = program.communicate(timeout=DEADLINE_S)
        self.assertEqual(program.returncode, 1)
        self.assertIn("identify: ", error)
        self.assertEqual(set(json.loads(self.record.read_text())["channel-1"]), {"describe", "calibrate"})

    def test_on_a_terminal_an_interruption_is_said_on_a_line_of_its_own(self):
        self.assertEqual(self.setup_program(*self.script()).returncode, 0)
        simulator = Simulator(self.path, "bench", "--board", self.board)
        self.addCleanup(simulator.end)
        bus = ("--can", f"socketcand:{simulator.port}")

        def interrupted(step, shown):
            for _ in range(TRIES):
                subprocess.run([SUPERCOIL, "command", "1", "reset", *bus], capture_output=True, timeout=DEADLINE_S)
                with Terminal(step, "--config", self.board, *bus) as terminal:
                    try:
                        terminal.until(shown)
                    except AssertionError:
                        if not any(why in terminal.told for why in STARVED):
                            raise
                        continue
                    terminal.type("\x03")
                    self.assertEqual(terminal.ended(), 1)
                    return terminal.told
            raise AssertionError(terminal.told)

        self.assertRegex(interrupted("senses", r"volts at the supply terminals \S+ to \S+: $"), r": \^C\r\nsupercoil: senses: interrupted\r\n$")
        told = interrupted("identify", r"identify: \d+ %")
        self.assertTrue(told.endswith("\r\x1b[Ksupercoil: identify: interrupted\r\n"), told[-200:])

    def test_the_recommended_controller_is_taken_by_whom_or_what_answers(self):
        self.assertEqual(self.setup_program(*self.script()).returncode, 0)
        simulator = Simulator(self.path, "bench", "--board", self.board)
        self.addCleanup(simulator.end)
        bus = ("--can", f"socketcand:{simulator.port}")

        def bandwidth(*change):
            done = self.patiently(lambda: subprocess.run([SUPERCOIL, "tune", "1", *change, "--json", *bus], capture_output=True,
                                                         text=True, timeout=DEADLINE_S))
            told = json.loads(done.stdout)["controllers"][0]["bandwidth_rad_per_s"]
            return round(told["in_use"], 2), round(told["stored"], 2)

        def gains(told, *arguments, **options):
            done = self.patiently(lambda: self.setup_program("gains", *bus, *arguments, **options))
            self.assertIn(told, done.stdout)
            return done.stdout

        slow = ("bandwidth_rad_per_s=3", "--store")
        self.assertEqual(bandwidth(*slow), (3.0, 3.0))
        told = gains("kept as it is", stdin=subprocess.DEVNULL)
        self.assertRegex(told, r"in use: controller 0, learned_ff: bandwidth_rad_per_s = 3, .*reference_model = design")
        self.assertRegex(told, r"with it: margin 0\.\d+, holds if no parameter is off by more than \d+ %; promises at most \d+")
        self.assertRegex(told, r"recommended for this muscle: .*bandwidth_rad_per_s = 7\.8\d+ }: .*, 1\.88 s, in units of")
        self.assertIn("keep the one in use (0 to 1) [1]: ", told)
        gains("kept as it is", *self.script(take_gains=0))
        self.assertEqual(bandwidth(), (3.0, 3.0))
        gains("taken over, and stored", *self.script())
        self.assertEqual(bandwidth(), (7.88, 7.88))
        gains("it is in use already: nothing changes", stdin=subprocess.DEVNULL)
        bandwidth(*slow)
        gains("taken over, and stored", input="1\n")
        self.assertEqual(bandwidth(), (7.88, 7.88))
        self.assertEqual(set(json.loads(self.record.read_text())["channel-1"]), {"describe", "gains"})

    def test_a_limit_that_is_answered_goes_into_the_boards_file(self):
        self.assertEqual(self.setup_program(*self.script()).returncode, 0)
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
                told, error = program.communicate("1\n", timeout=DEADLINE_S)
            return program.returncode, told, error

        for _ in range(TRIES):
            status, told, error = answer_at_4_mm()
            if not any(why in error for why in STARVED):
                break
        self.assertEqual(status, 0, error)
        limit = re.search(r"limit: ([\d.]+) mm \(configured: 25 mm\)", told)
        self.assertGreater(float(limit[1]), 3.5)
        written = f"max_travel_m = {1e-3 * float(limit[1]):.4g}"
        self.assertIn(written, self.board.read_text())
        self.assertEqual(self.board.read_text().replace(written, "max_travel_m = 0.025"), before)
        self.assertEqual((self.path / "board.toml.before-setup").read_text(), self.example)
        self.assertEqual(set(json.loads(self.record.read_text())["channel-1"]), {"describe", "limits"})
        state = subprocess.run([SUPERCOIL, "command", "state", "--can", bus], capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertRegex(state.stdout, "node 1: disarmed")

    def test_a_joint_is_set_up_by_its_agonist(self):
        self.example = (EXAMPLE.parent / "joint-as5600-ads1115.toml").read_text()
        self.board.write_text(self.example)
        script = self.script(heated_mm=6.5, stretch_mm=30, max_travel_mm=8)
        for channel in ("1", "2"):
            done = self.setup_program("describe", "--channel", channel, *script)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("it turns a joint: answer as it moves the joint alone", done.stdout)
            self.assertIn("Weights hang at the lever, 15 mm from the axis", done.stdout)
        self.board.write_text(self.example.replace("lever_m = 0.015", "lever_m = [0.012, 0.016, 0.012]\nlever_range_deg = [-40, 40]"))
        done = self.setup_program("describe", "--channel", "1", *script)
        self.assertIn("Weights hang at the lever, 16 mm from the axis", done.stdout)
        self.board.write_text(self.example)
        for step, channel, told in (("move", "2", "channel 2 is a joint's antagonist: set up its agonist instead, --channel 1"),
                                    ("scale", "1", "channel 1 turns a joint: the file's m_per_count and lever_m are its scale"),
                                    ("move", "1", "start the board with")):
            done = self.setup_program(step, "--channel", channel, "--socket", self.path / "none")
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"{step}: ", done.stderr)
            self.assertIn(told, done.stderr)
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

        told = re.search(r"refused: out_of_range; 0\.008\d* would be obeyed \((30\.\d+deg)\)", positioned("80deg").stderr)
        self.assertEqual(positioned(told[1]).returncode, 0)  # to the digit


if __name__ == "__main__":
    unittest.main()
