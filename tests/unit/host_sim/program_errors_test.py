"""supercoil-sim when something is wrong or stops it: exit status, messages, and the files that are left."""

import contextlib
import json
import os
import pty
import re
import resource
import signal
import subprocess
import time
import unittest

from sim_program import EXAMPLES, PROGRAM, SHORT, ProgramCase


class Errors(ProgramCase):
    def test_learned_in_a_missing_folder_is_wrong_input(self):
        done = self.run_program("run", self.scenario(SHORT), "--learned", "nowhere")
        self.assertEqual(done.returncode, 2)
        self.assertIn("nowhere", done.stderr)

    def test_the_number_of_nodes_is_limited_by_the_bus(self):
        scenario = self.scenario(SHORT)
        for nodes in (0, 9):
            self.check_refused(f"--nodes: Value {nodes} not in range 1 to 8", "run", scenario, "--out", "out", "--nodes",
                               nodes)
        self.check_refused("--learned excludes --nodes", "run", scenario, "--out", "out", "--nodes", 2, "--learned", ".")
        board = (EXAMPLES / "raspberry-pi-pwm-ads1115.toml").read_text()
        (self.path / "board.toml").write_text(re.sub(r"first_node = \d+", "first_node = 62", board))
        self.check_refused("--nodes 8: must be 1 to 2, as the first board is node 62", "run", scenario, "--board", "board.toml",
                           "--out", "out", "--nodes", 8)
        board = (EXAMPLES / "joint-as5600-ads1115.toml").read_text()
        (self.path / "board.toml").write_text(re.sub(r"first_node = \d+", "first_node = 60", board))
        self.check_refused("--nodes 3: must be 1 to 2, as the first board is node 60", "run", self.scenario(SHORT + "[joint]\n"), "--board",
                           "board.toml", "--out", "out", "--nodes", 3)

    def check_refused(self, message, *arguments):
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(message, done.stderr)
        self.assertFalse((self.path / "out").exists(), "something was written")

    def test_wrong_scenarios_end_with_status_2_and_write_nothing(self):
        for text, message in [
                ("plant.stiffnes_N_per_m = 12.0", "s.toml:1: plant.stiffnes_N_per_m = 12: "),
                ("\nplant.moving_mass_kg = -0.09", "s.toml:2: plant.moving_mass_kg = -0.09: must be"),
                ("plant.damping_Ns_per_m = nan", "plant.damping_Ns_per_m = nan: must be"),
                ("simulation.duration = 3.0", "did you mean duration_s (the unit is part"),
                ("power.max_W = 'much'", "power.max_W = 'much': must be a number"),
                ("[plant", "s.toml:1: is not valid TOML")]:
            with self.subTest(text):
                self.check_refused(message, "run", self.scenario(text), "--out", "out")

    def test_a_missing_scenario(self):
        self.check_refused("none.toml: there is no such file", "run", "none.toml", "--out", "out")

    def test_an_output_folder_that_cannot_be_written(self):
        (self.path / "file").write_text("x")
        self.check_refused("file: ", "run", self.scenario(SHORT), "--out", "file")
        self.check_refused("/proc/none: cannot be created", "run", self.scenario(SHORT),
                           "--out", "/proc/none")
        self.check_refused("/proc/none: cannot be created", "reproduce", "--out", "/proc/none")

    def test_scenarios_that_cannot_share_a_bus(self):
        (self.path / "a.toml").write_text(SHORT)
        for text, message in (("simulation.duration_s = 3.0\n", "b.toml: simulation.duration_s = 3: must be 2, as in a: "),
                              (SHORT + "simulation.rate_Hz = 500.0\n", "b.toml: simulation.rate_Hz = 500: must be 1000, as in a: ")):
            (self.path / "b.toml").write_text(text)
            self.check_refused(message, "run", "a.toml", "b.toml", "--out", "out")
        (self.path / "b.toml").write_text(SHORT)
        both = ("run", "a.toml", "b.toml", "--out", "out")
        self.check_refused("--nodes 2: applies to one scenario, but there are 2 scenarios", *both, "--nodes", 2)
        self.check_refused("--learned .: applies to one board, but there are 2 scenarios", *both, "--learned", ".")
        example = EXAMPLES / "raspberry-pi-pwm-ads1115.toml"
        self.check_refused("is given 1 times for 2 scenarios: give it once for each, or not at all", *both, "--board", example)
        self.check_refused("--board: is given 2 times: give it at most once for each SCENARIO", "run", "a.toml", "--out", "out", "--board", example,
                           "--board", example)
        self.check_refused("can.first_node = 1: is node 1, and ", *both, "--board", example, "--board", example)
        self.check_refused("would be node 64, but the highest node is 63", "run", *["a.toml"] * 64, "--out", "out")

    def test_a_board_and_a_scenario_that_do_not_match(self):
        example = EXAMPLES / "raspberry-pi-pwm-ads1115.toml"
        for text, options, message in (
                (SHORT + "power.supply_V = 24.0\n", [], "power.supply_V = 24 is outside the board's supply.min_V to max_V, 10.8 to 13.2"),
                (SHORT + "[[event]]\nat_s = 1.0\ncontroller.kind = 'pi'\n", [], "event at 1 s changes [controller]"),
                (SHORT, ["--channel", 3], "--channel 3: must be 1 to 2, the channels of ")):
            done = self.run_program("run", self.scenario(text), "--board", example, *options, "--out", "out")
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)
            self.assertFalse((self.path / "out").exists())
        (self.path / "board.toml").write_text("[bord]\n")
        done = self.run_program("run", self.scenario(SHORT), "--board", "board.toml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("board.toml:1: bord", done.stderr)

    def test_a_joint_and_a_board_that_do_not_match(self):
        pair, alone = (EXAMPLES / f"{name}.toml" for name in ("joint-as5600-ads1115", "raspberry-pi-pwm-ads1115"))
        for text, board, message in (
                ("", pair, "channel 2 of the board's file turns a joint: the scenario needs a [joint] with opposed_by = \"muscle\""),
                ("joint.opposed_by = 'spring'\n", pair, "channel 2 of the board's file turns a joint"),
                ("[joint]\n[[event]]\nat_s = 1.0\njoint.co_contraction_W = 4.0\n", pair,
                 "an event's joint.co_contraction_W = 4 is more than the board's max_co_contraction_W, 2.2"),
                ("[joint]\n", alone, "the scenario has a [joint] of two muscles, but channel 2 of the board's file is in no [[joint]]"),
                ("joint.lever_m = 0.02\n", pair, "joint.lever_m = 0.02 is not the board's, 0.015"),
                ("[joint]\nlever_m = [0.012, 0.015]\nlever_range_deg = [-20.0, 20.0]\n", pair,
                 "joint.lever_m = [0.012, 0.015] over -20 to 20 deg is not the board's, 0.015")):
            self.check_refused(message, "run", self.scenario(SHORT + text), "--board", board, "--channel", 2, "--out", "out")
        finger = self.path / "finger.toml"
        finger.write_text(alone.read_text() + '\n[[joint]]\nopposed_by = "spring"\nagonist = 1\nlever_m = 0.015\n')
        for text, message in (
                ("", "channel 1 of the board's file turns a joint alone: the scenario needs a [joint] with opposed_by = \"spring\""),
                ("[joint]\nopposed_by = 'spring'\nlever_m = 0.02\n", "joint.lever_m = 0.02 is not the board's, 0.015"),
                ("[joint]\n", "the scenario has a [joint] of two muscles, but channel 1 of the board's file is in no [[joint]]")):
            self.check_refused(message, "run", self.scenario(SHORT + text), "--board", finger, "--out", "out")
        finger.write_text(finger.read_text().replace('"spring"', '"gravity"') + "weight_Nm = 0.001\nhangs_at_deg = -60\n")
        self.check_refused("the scenario needs a [joint] with opposed_by = \"gravity\"", "run", self.scenario(SHORT), "--board", finger, "--out", "out")

    def test_a_bundle_and_a_board_that_do_not_match(self):
        alone = EXAMPLES / "raspberry-pi-pwm-ads1115.toml"
        pair = self.path / "bundle.toml"
        text = (EXAMPLES / "joint-as5600-ads1115.toml").read_text()
        pair.write_text(text[:text.index("[[joint]]")] + "[[bundle]]\nchannels = [1, 2]\n")
        for text, board, message in (
                ("", pair, "channel 1 of the board's file is in a [[bundle]] of 2 muscles, but the scenario has no [bundle]"),
                ("bundle.muscles = 3\n", pair, "is in a [[bundle]] of 2 muscles, but the scenario has a [bundle] of 3"),
                ("[bundle]\n", alone, "channel 1 of the board's file is in no [[bundle]], but the scenario has a [bundle] of 2")):
            self.check_refused(message, "run", self.scenario(SHORT + text), "--board", board, "--out", "out")

    def test_a_window_outside_the_run(self):
        for window in ["1:99", "2:1", "x:y", "5"]:
            self.check_refused("must be FROM:TO", "run", self.scenario(SHORT), "--out", "out",
                               "--window", window)

    def test_errors_of_a_check_have_a_json_form(self):
        board = self.path / "board.toml"
        board.write_text("[bord]\n")
        right = EXAMPLES / "raspberry-pi-pwm-ads1115.toml"
        last = self.path / "last.toml"
        last.write_text(re.sub(r"first_node = \d+", "first_node = 62", right.read_text()))
        for text, options, found in (
                ("\nplant.moving_mass_kg = -0.09", [], ("s.toml", 2, "plant.moving_mass_kg", "-0.09")),
                (SHORT, ["--window", "1:99"], ("", 0, "--window", "1:99")),
                (SHORT, ["--board", last, "--nodes", 8], ("", 0, "--nodes", "8")),
                (SHORT, ["--nodes", 9], ("", 0, "", "")),
                (SHORT, ["--learned", "nowhere"], ("", 0, "--learned", "")),
                (SHORT, ["--board", "board.toml"], ("board.toml", 1, "bord", "")),
                (SHORT, ["--board", right, "--channel", 3], ("", 0, "--channel", "3")),
                (SHORT + "power.supply_V = 24.0\n", ["--board", right], (f"s.toml on {right}", 0, "", ""))):
            with self.subTest(options):
                done = self.run_program("run", self.scenario(text), "--check", "--json", *options)
                self.assertEqual((done.returncode, done.stderr), (2, ""))
                problems = json.loads(done.stdout)["problems"]
                self.assertIn(found, [tuple(problem[key] for key in ("file", "line", "key", "value")) for problem in problems])
                self.assertTrue(all(problem["message"] for problem in problems))

    def test_unknown_options_and_commands(self):
        self.assertEqual(self.run_program("run").returncode, 2)
        self.assertEqual(self.run_program("fly").returncode, 2)
        self.assertEqual(self.run_program().returncode, 2)
        for words in (("--foo",), ("run", "--foo"), ("run", "sine", "--foo=3")):
            done = self.run_program(*words)
            self.assertEqual((done.returncode, done.stderr.splitlines()[0]),
                             (2, "supercoil-sim: --foo is not an option; --help lists those that there are"))

    def test_a_misspelt_name_suggests_the_nearest_one(self):
        self.check_refused("supercoil-sim: 'rum' is not a command; did you mean run?", "rum", "sine")
        self.check_refused("'fly' is not a command; the commands are: run, page, reproduce, ", "fly")
        self.check_refused("supercoil-sim: --evry is not an option; did you mean --every?", "run", "sine", "--evry", "3")
        self.check_refused("'2' is one argument too many; --help lists those that are expected", "reproduce", "2", "2")
        self.check_refused("sin: there is no such file, and no built-in scenario has that name; did you mean sine?", "run", "sin", "--out", "out")
        self.check_refused("no built-in scenario has that name; the built-in scenarios are: b, bench, ", "run", "zzz", "--out", "out")

    def test_a_full_disk_ends_with_status_1_and_leaves_nothing(self):
        def small_disk():
            resource.setrlimit(resource.RLIMIT_FSIZE, (50000, 50000))
        done = self.run_program("run", self.scenario(SHORT), "--out", "out", "--no-plot",
                                preexec_fn=small_disk, restore_signals=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr, "supercoil-sim: out/trace.csv: cannot be written: File too large\n")
        self.assertFalse((self.path / "out").exists())

    def test_a_plot_too_large_for_the_disk_is_left_out(self):
        for bytes_left, why in ((50000, "plot.svg.part.gnuplot: cannot be written"), (350000, "gnuplot could not write all of it")):
            def small_disk():
                resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_left, bytes_left))
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            done = self.run_program("run", self.scenario("simulation.duration_s = 20.0\n"), "--out", "out", "--no-trace",
                                    "--no-can", preexec_fn=small_disk, restore_signals=False)
            self.assertIn(why, done.stderr)
            self.assertEqual([file.name for file in (self.path / "out").iterdir()], ["summary.json"])

    def test_a_killed_run_keeps_an_earlier_result_and_the_next_run_cleans_up(self):
        self.run_program("run", self.scenario(SHORT), "--out", "out", "--no-plot")
        earlier = (self.path / "out/trace.csv").read_bytes()
        running = self.start_long_run()
        running.kill()
        running.communicate()
        self.assertEqual((self.path / "out/trace.csv").read_bytes(), earlier)
        self.run_program("run", self.scenario(SHORT), "--out", "out", "--no-plot")
        self.assertEqual(sorted(p.name for p in (self.path / "out").iterdir()),
                         ["can.log", "summary.json", "trace.csv"])

    def test_without_gnuplot_the_results_are_kept_without_the_plot(self):
        done = self.run_program("run", self.scenario(SHORT), "--out", "out",
                                env={"PATH": "/nowhere"})
        self.assertEqual(done.returncode, 0)
        self.assertIn("plot.svg was not written: gnuplot is not installed", done.stderr)
        self.assertEqual(sorted(p.name for p in (self.path / "out").iterdir()),
                         ["can.log", "summary.json", "trace.csv"])

    def test_reproduce_without_gnuplot_still_gives_the_table(self):
        done = self.run_program("reproduce", "--out", "out", env={"PATH": "/nowhere"})
        self.assertEqual(done.returncode, 0)
        self.assertIn("figure2.svg was not written: gnuplot is not installed", done.stderr)
        self.assertEqual(sorted(p.name for p in (self.path / "out").iterdir()),
                         ["report.html", "reproduction.csv"])

    def start_long_run(self):
        """A run of minutes that has already begun to write."""
        self.scenario("simulation.duration_s = 20000.0\n")
        running = subprocess.Popen([PROGRAM, "run", "s.toml", "--out", "out", "--no-plot"],
                                   cwd=self.path, stderr=subprocess.PIPE, text=True)
        part = self.path / "out/trace.csv.part"
        while not (part.exists() and part.stat().st_size > 1000000):
            self.assertIsNone(running.poll(), "it ended too early")
            time.sleep(0.01)
        return running

    def test_an_interrupted_run_leaves_nothing(self):
        for number in [signal.SIGINT, signal.SIGTERM]:
            running = self.start_long_run()
            running.send_signal(number)
            errors = running.communicate()[1]
            self.assertEqual(running.returncode, 130)
            self.assertRegex(errors, r"^supercoil-sim: interrupted at [\d.]+ s of 20000 s; only recordings of "
                                     "faults are kept\n$")
            self.assertFalse((self.path / "out").exists())

    def test_on_a_terminal_a_run_in_real_time_shows_its_progress(self):
        self.scenario("simulation.duration_s = 86400.0\n")
        screen, terminal = pty.openpty()
        running = subprocess.Popen([PROGRAM, "run", "s.toml", "--out", "out", "--real-time"], cwd=self.path,
                                   stdout=subprocess.DEVNULL, stderr=terminal)
        os.close(terminal)
        seen = ""
        while not seen.endswith(" left"):
            seen += os.read(screen, 4096).decode()
        running.send_signal(signal.SIGINT)
        running.wait()
        os.close(screen)
        self.assertRegex(seen, r"\r\x1b\[Ks: 0 %  \d+ s of 86400 s simulated, \d+ min left$")

    def test_on_a_terminal_the_message_of_an_interruption_has_its_own_line(self):
        self.scenario("simulation.duration_s = 20000.0\n")
        screen, terminal = pty.openpty()
        running = subprocess.Popen([PROGRAM, "run", "s.toml", "--out", "out", "--no-plot", "--no-trace", "--no-can"],
                                   cwd=self.path, stderr=terminal)
        os.close(terminal)
        seen = ""
        while not seen.endswith(" left"):
            seen += os.read(screen, 4096).decode()
        running.send_signal(signal.SIGINT)
        running.wait()
        with contextlib.suppress(OSError):  # the end of a terminal
            while True:
                seen += os.read(screen, 4096).decode()
        os.close(screen)
        self.assertRegex(seen, r"\r\x1b\[Ks: \d+ %  \d+ s simulated, \d+ (s|min) left")
        self.assertRegex(seen, r"\r\x1b\[Ksupercoil-sim: interrupted at [^\r\n]*\r\n$")

    def test_two_runs_do_not_write_into_one_folder(self):
        running = self.start_long_run()
        (self.path / "short.toml").write_text(SHORT)
        done = self.run_program("run", "short.toml", "--out", "out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("out: another run is writing into it", done.stderr)
        self.assertTrue((self.path / "out/trace.csv.part").exists())
        running.kill()
        running.communicate()

    def test_a_full_standard_output_is_an_error(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, "list"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot write to standard output", done.stderr)

    def test_a_name_that_is_not_utf8(self):
        name = os.fsencode(self.path) + b"/\xff.toml"
        with open(name, "w") as file:
            file.write(SHORT)
        done = subprocess.run([PROGRAM, "run", name, "--out", "out", "--no-plot"], cwd=self.path,
                              capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        json.loads((self.path / "out/summary.json").read_text())


if __name__ == "__main__":
    unittest.main()
