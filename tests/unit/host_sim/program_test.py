"""supercoil-sim as seen by a user or a script: what it writes and prints."""

import csv
import json
import re
import signal
import subprocess
import time
import tomllib
import unittest

from sim_program import EXAMPLES, PROGRAM, SHORT, ProgramCase


class Results(ProgramCase):
    def test_a_fault_is_printed_summarised_and_recorded(self):
        text = "simulation.duration_s = 14.0\n[[event]]\nat_s = 12.0\ninjected_fault.heater_open = true\n"
        done = self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--no-trace")
        self.assertEqual((done.returncode, done.stderr),
                         (1, "supercoil-sim: the run ended in fault 20 heater_open; see faults/heater_open in `supercoil-sim docs` (--allow-fault: "
                             "exit status 0)\n"))
        self.assertIn("fault 20 heater_open at 12.", done.stdout)
        self.assertIn("flight-1.scfr", done.stdout)
        fault, = json.loads((self.path / "out/summary.json").read_text())["faults"]
        self.assertEqual((fault["number"], fault["name"]), (20, "heater_open"))
        self.assertAlmostEqual(fault["at_s"], 12.02, delta=0.03)
        # 10 s before and 1 s after, one row per tick.
        recording = (self.path / "out/flight-1.scfr").read_bytes()
        self.assertGreater(len(recording), 11000 * 112)
        self.assertLess(len(recording), 11002 * 112 + 4096)

    def test_the_exit_status_shows_whether_any_motion_was_tracked(self):
        options = ["--out", "out", "--no-plot", "--no-trace", "--no-can"]
        broken = "simulation.duration_s = 3.0\n[[event]]\nat_s = 1.0\ninjected_fault.heater_open = true\n"
        mended = broken + "[[event]]\nat_s = 2.0\nreset = true\ninjected_fault.heater_open = false\n"
        for text, allowed, status, message in (
                (broken, False, 1, "ended in fault 20 heater_open"), (broken, True, 0, "ended in fault 20 heater_open"),
                (mended, False, 0, ""), (SHORT + "injected_fault.stop_pressed = true\n", False, 1, "never armed: fault 63 emergency_stop"),
                (SHORT + "simulation.rate_Hz = 100.0\ncontroller.kind = 'pi'\nthermal.transfer_ratio = [0.01, 2.2]\n"
                 "thermal.mass_ratio = [0.75, 100.0]\n", False, 1,
                 "never armed: with these [thermal] bounds the muscle may still be hot"),
                (SHORT + "operator.action = 'none'\n", False, 0, "never armed: [operator] action is none or disarm"),
                (SHORT + "operator.action = 'none'\n[[event]]\nat_s = 1.0\noperator.action = 'track'\n", False, 1,
                 "never armed: [operator] action is none or disarm at the start, and the operator arms only there")):
            done = self.run_program("run", self.scenario(text), *options, *["--allow-fault"] * allowed)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertIn(message, done.stderr if status else done.stdout)
            summary = json.loads((self.path / "out/summary.json").read_text())
            why = summary["never_armed_because"]
            self.assertEqual((summary["armed"], f"never armed: {why}" in done.stderr + done.stdout), (why is None, why is not None))
            for fault in summary["faults"]:
                self.assertEqual(fault["page"], f"docs/faults/{fault['name']}.md")

    def test_a_first_motion_reports_whether_it_ended_and_kept_its_promise(self):
        def run(duration_s):
            text = f"simulation.duration_s = {duration_s}\noperator.action = 'first_motion'\ncontroller.kind = 'learned_ff'\n"
            return self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--no-trace", "--no-can")
        cut = run(4.0)
        self.assertEqual((cut.returncode, "the first motion did not finish" in cut.stderr), (1, True), cut.stderr)
        whole = run(60.0)
        self.assertEqual((whole.returncode, whole.stderr), (0, ""))
        self.assertRegex(whole.stdout, r"\nfirst motion: followed within [\d.]+ um rms; the promise of [\d.]+ um is kept\n")

    def test_the_ratio_of_ticks_at_each_limit_is_printed(self):
        done = self.run_program("run", self.scenario(SHORT + "power.max_W = 0.5\n"), "--out", "out", "--no-plot")
        with open(self.path / "out/trace.csv") as file:
            limits = [row["limited_by"] for row in csv.DictReader(file)]
        shares = {limit: f"{limit} {limits.count(limit) / 20:.1f} %" for limit in limits if limit != "nothing"}
        self.assertIn("maximum", shares)
        line, = re.findall("at a limit in (.*) % of the ticks: (.*)", done.stdout)
        self.assertEqual(line[0], f"{100 - limits.count('nothing') / 20:.1f}")
        self.assertEqual(sorted(line[1].split(", ")), sorted(shares.values()))

    def test_learned_values_are_stored_and_used_by_the_next_run(self):
        (self.path / "memory").mkdir()
        text = ("simulation.duration_s = 82.0\noperator.action = 'identify'\n"
                "muscle.stiffness_N_per_m = 22.0\n")
        options = ["--learned", "memory", "--no-plot", "--no-trace", "--quiet"]
        for out in ("first", "second"):
            done = self.run_program("run", self.scenario(text), "--out", out, *options)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        stored = (self.path / "memory/learned-1.toml").read_text()
        self.assertIn("version = 2", stored)
        self.assertRegex(stored, r"stiffness_N_per_m = 1[56]\.")
        (self.path / "memory/learned-1.toml").write_text("version = 9\n")
        done = self.run_program("run", "s.toml", "--out", "third", *options)
        self.assertEqual(done.returncode, 0)
        self.assertIn("memory/learned-1.toml:", done.stderr)

    def test_learned_values_of_both_muscles_of_a_joint_are_stored(self):
        (self.path / "memory").mkdir()
        text = "simulation.duration_s = 240.0\noperator.action = 'identify'\n[joint]\nantagonist.force_per_kelvin_N_per_K = 0.01\n"
        for extra in ([], ["--board", EXAMPLES / "joint-as5600-ads1115.toml"]):
            done = self.run_program("run", self.scenario(text), "--out", "out", "--learned", "memory", "--no-plot", "--no-trace", "--quiet", *extra)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            summary = json.loads((self.path / "out/summary.json").read_text())
            for channel, key in ((1, "learned"), (2, "learned_antagonist")):
                stored = tomllib.loads((self.path / f"memory/learned-{channel}.toml").read_text())
                self.assertEqual(stored["muscle"]["stiffness_N_per_m"], summary[key]["stiffness_N_per_m"])
                self.assertAlmostEqual(summary[key]["stiffness_N_per_m"], 32.0, delta=3.0)
        self.assertEqual(stored["version"], 2)

    def test_learned_values_outlive_a_killed_or_interrupted_run(self):
        self.scenario("simulation.duration_s = 200000.0\noperator.action = 'calibrate'\n")
        for end in (signal.SIGKILL, signal.SIGINT, signal.SIGTERM):
            memory = self.path / f"memory-{end}"
            memory.mkdir()
            with subprocess.Popen([PROGRAM, "run", "s.toml", "--out", "out", "--learned", memory, "--no-plot", "--no-trace", "--no-can",
                                   "--quiet"], cwd=self.path, stderr=subprocess.PIPE, text=True) as running:
                while not (memory / "learned-1.toml").exists():
                    self.assertIsNone(running.poll(), "it ended before it had learned")
                    time.sleep(0.01)
                running.send_signal(end)
                errors = running.communicate()[1]
            self.assertEqual(running.returncode, -9 if end == signal.SIGKILL else 130)
            if end != signal.SIGKILL:
                self.assertTrue(errors.endswith("; only recordings of faults and learned sets are kept\n"), errors)
            self.assertEqual(tomllib.loads((memory / "learned-1.toml").read_text())["version"], 1)

    def test_a_run_that_cannot_store_learned_values_reports_it_and_fails(self):
        memory = self.path / "memory"
        memory.mkdir()
        (memory / "learned-1.toml.new").mkdir()
        text = "simulation.duration_s = 60.0\noperator.action = 'calibrate'\n"
        done = self.run_program("run", self.scenario(text), "--out", "out", "--learned", memory, "--no-plot", "--no-trace", "--quiet")
        self.assertEqual(done.returncode, 1)
        self.assertIn("supercoil-sim: channel 1 learned, but it is not stored: ", done.stderr)
        self.assertTrue((self.path / "out/summary.json").exists())

    def test_run_writes_trace_summary_and_plot(self):
        done = self.run_program("run", self.scenario(SHORT), "--out", "out", "--window", "1:2")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(sorted(p.name for p in (self.path / "out").iterdir()),
                         ["can.log", "plot.svg", "summary.json", "trace.csv"])
        with open(self.path / "out/trace.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 2000)
        summary = json.loads((self.path / "out/summary.json").read_text())
        late = [(float(r["position_m"]) - float(r["model_m"])) ** 2 for r in rows[1000:]]
        self.assertAlmostEqual(summary["tracking_rms_m"], (sum(late) / len(late)) ** 0.5, places=12)
        self.assertEqual(summary["ticks"], 2000)
        self.assertGreater(summary["realtime_factor"], 0)

    def test_the_plot_has_one_time_axis_and_names_of_states(self):
        # The muscle follows a reference model only from 15 to 20 s.
        self.run_program("run", self.scenario(
            "simulation.duration_s = 40.0\noperator.action = 'calibrate'\n[[event]]\nat_s = 15.0\noperator.action = 'track'\n"
            "[[event]]\nat_s = 20.0\ninjected_fault.heater_open = true\n"), "--out", "out", "--no-trace", "--no-can")
        drawing = (self.path / "out/plot.svg").read_text()
        self.assertLessEqual({"disarmed", "armed", "active", "fault"}, set(re.findall("<text>(.*)</text>", drawing)))
        ends = re.findall(r'translate\(([\d.]+),[\d.]+\)"[^>]*text-anchor="middle"[^>]*>\s*<text> *40</text>', drawing)
        self.assertEqual((len(ends), len(set(ends))), (6, 1))

    def test_the_same_scenario_gives_the_same_trace(self):
        for name in "ab":
            self.run_program("run", self.scenario(SHORT), "--out", name, "--no-plot")
        self.assertEqual((self.path / "a/trace.csv").read_bytes(),
                         (self.path / "b/trace.csv").read_bytes())

    def test_every_no_trace_and_no_can(self):
        self.run_program("run", self.scenario(SHORT), "--out", "out", "--no-plot", "--every", 10)
        self.assertEqual(len((self.path / "out/trace.csv").read_text().splitlines()), 201)
        self.run_program("run", self.scenario(SHORT), "--out", "none", "--no-plot", "--no-trace",
                         "--no-can")
        self.assertEqual([p.name for p in (self.path / "none").iterdir()], ["summary.json"])

    def test_a_run_in_real_time_has_the_same_exit_status_when_commanded(self):
        broken = "simulation.duration_s = 1.5\ninjected_fault.heater_open = true\n"
        for text, options, status in ((broken, [], 1), (broken, ["--allow-fault"], 0),
                                      ("simulation.duration_s = 0.5\n", [], 0),
                                      (broken + "operator.action = 'none'\n", [], 0)):
            done = self.run_program("run", self.scenario(text), "--real-time", "--out", "out", *options)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertEqual("fault 20 heater_open" in done.stderr, status == 1)

    def test_an_oscillating_loop_is_reported_with_its_period(self):
        text = ("simulation.duration_s = 60.0\nplant.damping_Ns_per_m = 0.12\nmuscle.damping_Ns_per_m = 0.12\n"
                "controller = {kind = 'adaptive_ff', slow_when_oscillating = false}\n")
        done = self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--no-trace", "--no-can")
        summary = json.loads((self.path / "out/summary.json").read_text())
        self.assertAlmostEqual(summary["oscillation_period_s"], 0.5, delta=0.2)
        self.assertIn(f"with a period of {summary['oscillation_period_s']:.2g} s", done.stderr)

    def test_a_run_in_real_time_reports_how_far_it_got(self):
        self.scenario("simulation.duration_s = 86400.0\n")
        running = subprocess.Popen([PROGRAM, "run", "s.toml", "--out", "out", "--real-time"], cwd=self.path,
                                   stdout=subprocess.PIPE, text=True)
        running.stdout.readline()
        time.sleep(0.5)
        running.send_signal(signal.SIGINT)
        output = running.communicate()[0]
        summary = json.loads((self.path / "out/summary.json").read_text())
        self.assertEqual(summary["window_s"][0], 0)
        self.assertAlmostEqual(summary["window_s"][1], summary["ticks"] / 1000)
        self.assertIn(f"\nended at {summary['ticks'] / 1000:g} s of 86400 s\n", output)
        self.assertIn(f"(0 to {summary['ticks'] / 1000:g} s)", output)

    def test_a_power_of_nan_is_reported(self):
        done = self.run_program("run", self.scenario(
            SHORT + "controller = {p0_rad_per_s = -1000.0, accept_failed_premises = true}"),
            "--out", "out", "--no-plot")
        self.assertIn("power was NaN in", done.stderr)
        summary = json.loads((self.path / "out/summary.json").read_text())
        self.assertGreater(summary["not_finite_ticks"], 0)
        self.assertIn(",nan,", (self.path / "out/trace.csv").read_text().replace("-nan", "nan"))

    def summary_of(self, text):
        self.assertEqual(self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--quiet").returncode, 0)
        return json.loads((self.path / "out/summary.json").read_text())

    def test_summary_identifies_the_run_and_its_results(self):
        summary = self.summary_of(SHORT)
        version = self.run_program("--version").stdout.strip()
        self.assertEqual((summary["schema_version"], summary["program_version"], summary["seed"]), (6, version, 1))
        self.assertEqual(self.summary_of("# another comment\n" + SHORT)["scenario_crc32"], summary["scenario_crc32"])
        self.assertNotEqual(self.summary_of(SHORT + "power.pwm_bits = 11\n")["scenario_crc32"], summary["scenario_crc32"])

    def test_summary_has_a_hash_of_the_boards_file(self):
        self.assertIsNone(self.summary_of(SHORT)["board_crc32"])
        board = (EXAMPLES / "raspberry-pi-pwm-ads1115.toml").read_text()
        found = []
        for text in (board, "# another comment\n" + board, board.replace("max_travel_m = 0.025", "max_travel_m = 0.024")):
            (self.path / "board.toml").write_text(text)
            self.run_program("run", "s.toml", "--board", "board.toml", "--out", "out", "--no-plot", "--quiet")
            found.append(json.loads((self.path / "out/summary.json").read_text())["board_crc32"])
        self.assertEqual(found[0], found[1])
        self.assertNotEqual(found[0], found[2])

    def test_summary_has_the_ratio_of_ticks_at_each_limit(self):
        summary = self.summary_of(SHORT + "power.max_W = 0.01\n")
        self.assertGreater(summary["limited_by_ratio"]["maximum"], 0.5)
        self.assertLessEqual(sum(summary["limited_by_ratio"].values()), 1.0)
        self.assertNotIn("nothing", summary["limited_by_ratio"])

    def test_check_prints_the_keys_at_the_start(self):
        scenario = self.scenario(SHORT + "[[event]]\nat_s = 0.1\ncontroller.kind = 'pi'\n")
        done = self.run_program("run", scenario, "--check", "--keys")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"\nplant\.air_acts +false +false +true, false\n")
        self.assertNotIn("proportional_W_per_m", done.stdout)
        self.assertRegex(done.stdout, r"\nevent\.at_s +0\.1 +required +\d+ +0 to ")
        both = json.loads(self.run_program("run", "sine", "steps", "--check", "--keys", "--json").stdout)
        names = [[key["key"] for key in one["keys"]] for one in both]
        self.assertEqual([len(of_one) for of_one in names], [len(set(of_one)) for of_one in names])
        self.assertEqual([name in names[1] for name in ("reference.levels_m", "reference.offset_m")], [True, False])
        joint = self.run_program("run", "joint", "--check", "--keys").stdout
        self.assertRegex(joint, r"\njoint\.antagonist_muscle\.stiffness_N_per_m ")

    def test_check_and_list_write_nothing(self):
        checked = self.run_program("run", self.scenario(SHORT), "--check")
        self.assertEqual(checked.returncode, 0)
        self.assertIn("in order", checked.stdout)
        self.assertRegex(checked.stdout, r"\nmuscle: holds [\d.]+ mm indefinitely, at [\d.]+ W")
        self.assertRegex(checked.stdout, r"\nmuscle: controller 0 promises no error \(mrac\); the recommended one promises, once "
                                         r"the muscle is identified, at most [\d.]+ um rms on a sine of")
        self.assertRegex(checked.stdout, r"\nmuscle: controller 0: margin 0\.\d+ once adapted, holds if no parameter moves by more than")
        for gains, delay in ((20000, 0.04), (100000, 0.0)):
            unstable = f'controller = {{kind = "pi", proportional_W_per_m = {gains}, integral_W_per_m_s = 20000}}\npower.delay_s = {delay}\n'
            output = self.run_program("run", self.scenario(SHORT + unstable), "--check").stdout
            self.assertRegex(output, r"\nmuscle: controller 0: is unstable on this muscle with [\d.]+ ms of delay: lower its gains")
        listed = self.run_program("list")
        self.assertIn("sine", listed.stdout)
        self.assertIn("printed", listed.stdout)
        self.assertIn("joint          Two real muscles that differ by a tenth turn a joint by 20 degrees either way; after a minute a weight hangs on its arm\n", listed.stdout)
        self.assertEqual([p.name for p in self.path.iterdir()], ["s.toml"])

    def test_reproduce_writes_table_plots_and_page(self):
        done = self.run_program("reproduce", "--out", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(p.name for p in (self.path / "out").iterdir()),
                         ["figure2.svg", "figure3.svg", "figure4.svg", "physical.svg",
                          "report.html", "reproduction.csv"])
        with open(self.path / "out/reproduction.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]),
                         ["id", "case", "quantity", "unit", "paper", "measured", "remark"])
        page = (self.path / "out/report.html").read_text()
        self.assertEqual(page.count("<img "), 4)
        for row in rows:
            self.assertTrue(row["measured"], row)
            self.assertIn(row["id"], page)

    def test_help_and_version(self):
        self.assertIn("reproduce", self.run_program("--help").stdout)
        self.assertIn("--window", self.run_program("run", "--help").stdout)
        self.assertRegex(self.run_program("--version").stdout, r"^\d+\.\d+\.\d+")


if __name__ == "__main__":
    unittest.main()
