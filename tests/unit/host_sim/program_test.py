"""supercoil-sim as a user or a script meets it: what it writes and tells."""

import collections
import csv
import itertools
import json
import re
import signal
import subprocess
import time
import tomllib
import unittest

from sim_program import EXAMPLES, PROGRAM, SHORT, ProgramCase


class Results(ProgramCase):
    def test_a_fault_is_told_summarised_and_recorded(self):
        text = "simulation.duration_s = 14.0\n[[event]]\nat_s = 12.0\ninjected_fault.heater_open = true\n"
        done = self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--no-trace")
        self.assertEqual((done.returncode, done.stderr),
                         (1, "supercoil-sim: the run ended in fault 20 heater_open; docs/faults/heater_open.md (--allow-fault: "
                             "exit status 0)\n"))
        self.assertIn("fault 20 heater_open at 12.", done.stdout)
        self.assertIn("flight-1.scfr", done.stdout)
        fault, = json.loads((self.path / "out/summary.json").read_text())["faults"]
        self.assertEqual((fault["number"], fault["name"]), (20, "heater_open"))
        self.assertAlmostEqual(fault["at_s"], 12.02, delta=0.03)
        # 10 s before and 1 s after, a row a tick.
        recording = (self.path / "out/flight-1.scfr").read_bytes()
        self.assertGreater(len(recording), 11000 * 112)
        self.assertLess(len(recording), 11002 * 112 + 4096)

    def test_the_exit_status_tells_whether_anything_was_followed(self):
        options = ["--out", "out", "--no-plot", "--no-trace", "--no-can"]
        broken = "simulation.duration_s = 3.0\n[[event]]\nat_s = 1.0\ninjected_fault.heater_open = true\n"
        mended = broken + "[[event]]\nat_s = 2.0\nreset = true\ninjected_fault.heater_open = false\n"
        for text, allowed, status, told in (
                (broken, False, 1, "ended in fault 20 heater_open"), (broken, True, 0, "ended in fault 20 heater_open"),
                (mended, False, 0, ""), (SHORT + "injected_fault.stop_pressed = true\n", False, 1, "never armed: fault 63 emergency_stop"),
                (SHORT + "simulation.rate_Hz = 100.0\ncontroller.kind = 'pi'\nthermal.transfer_ratio = [0.01, 2.2]\n"
                 "thermal.mass_ratio = [0.75, 100.0]\n", False, 1,
                 "never armed: with these [thermal] bounds the muscle may still be hot"),
                (SHORT + "operator.action = 'none'\n", False, 0, "never armed: [operator] action is none or disarm"),
                (SHORT + "operator.action = 'none'\n[[event]]\nat_s = 1.0\noperator.action = 'track'\n", False, 1,
                 "never armed: [operator] action is none or disarm at the start, and it arms only there")):
            done = self.run_program("run", self.scenario(text), *options, *["--allow-fault"] * allowed)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertIn(told, done.stderr if status else done.stdout)
            summary = json.loads((self.path / "out/summary.json").read_text())
            why = summary["never_armed_because"]
            self.assertEqual((summary["armed"], f"never armed: {why}" in done.stderr + done.stdout), (why is None, why is not None))
            for fault in summary["faults"]:
                self.assertEqual(fault["page"], f"docs/faults/{fault['name']}.md")

    def test_a_first_motion_tells_whether_it_came_to_its_end_and_kept_its_promise(self):
        def run(duration_s):
            text = f"simulation.duration_s = {duration_s}\noperator.action = 'first_motion'\ncontroller.kind = 'learned_ff'\n"
            return self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--no-trace", "--no-can")
        cut = run(4.0)
        self.assertEqual((cut.returncode, "the first motion did not come to its end" in cut.stderr), (1, True), cut.stderr)
        whole = run(60.0)
        self.assertEqual((whole.returncode, whole.stderr), (0, ""))
        self.assertRegex(whole.stdout, r"\nfirst motion: followed within [\d.]+ um rms; the promise of [\d.]+ um is kept\n")

    def test_the_share_of_ticks_at_each_limit_is_told(self):
        done = self.run_program("run", self.scenario(SHORT + "power.max_W = 0.5\n"), "--out", "out", "--no-plot")
        with open(self.path / "out/trace.csv") as file:
            limits = [row["limited_by"] for row in csv.DictReader(file)]
        shares = {limit: f"{limit} {limits.count(limit) / 20:.1f} %" for limit in limits if limit != "nothing"}
        self.assertIn("maximum", shares)
        line, = re.findall("at a limit in (.*) % of the ticks: (.*)", done.stdout)
        self.assertEqual(line[0], f"{100 - limits.count('nothing') / 20:.1f}")
        self.assertEqual(sorted(line[1].split(", ")), sorted(shares.values()))

    def test_what_is_learned_is_kept_and_used_by_the_next_run(self):
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

    def test_what_is_learned_of_both_muscles_of_a_joint_is_kept(self):
        (self.path / "memory").mkdir()
        text = "simulation.duration_s = 240.0\noperator.action = 'identify'\n[joint]\nantagonist.force_per_kelvin_N_per_K = 0.01\n"
        for extra in ([], ["--board", EXAMPLES / "joint-as5600-ads1115.toml"]):
            done = self.run_program("run", self.scenario(text), "--out", "out", "--learned", "memory", "--no-plot", "--no-trace", "--quiet", *extra)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            summary = json.loads((self.path / "out/summary.json").read_text())
            for channel, told in ((1, "learned"), (2, "learned_antagonist")):
                stored = tomllib.loads((self.path / f"memory/learned-{channel}.toml").read_text())
                self.assertEqual(stored["muscle"]["stiffness_N_per_m"], summary[told]["stiffness_N_per_m"])
                self.assertAlmostEqual(summary[told]["stiffness_N_per_m"], 32.0, delta=3.0)
        self.assertEqual(stored["version"], 2)

    def test_what_was_learned_outlives_a_run_that_is_killed_or_interrupted(self):
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
                self.assertTrue(errors.endswith("; nothing of this run is kept but recordings of faults and what was learned\n"), errors)
            self.assertEqual(tomllib.loads((memory / "learned-1.toml").read_text())["version"], 1)

    def test_a_run_that_cannot_store_what_was_learned_says_so_and_fails(self):
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
        # The muscle follows a reference model from 15 to 20 s only.
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

    def test_nodes_are_boards_of_their_own_on_one_bus(self):
        noisy = SHORT + "sensor.position.noise_rms_m = 1e-5\n"
        for name in "ab":
            self.run_program("run", self.scenario(noisy), "--out", name, "--nodes", 3)
        a, b = self.path / "a", self.path / "b"
        self.assertEqual({str(file.relative_to(a)) for file in a.rglob("*.*")}, {"can.log", *(
            f"node-{node}/{name}" for node in (1, 2, 3) for name in ("trace.csv", "plot.svg", "summary.json"))})
        self.assertEqual((a / "can.log").read_bytes(), (b / "can.log").read_bytes())
        for node in (1, 2, 3):
            # As if it were alone with a seed of its own.
            self.run_program("run", self.scenario(noisy + f"simulation.seed = {node}\n"), "--out", f"seed-{node}")
            trace, alone, again = ((folder / "trace.csv").read_bytes() for folder in (
                a / f"node-{node}", self.path / f"seed-{node}", b / f"node-{node}"))
            self.assertEqual(trace, alone)
            self.assertEqual(trace, again)
            summary = json.loads((a / f"node-{node}/summary.json").read_text())
            self.assertEqual((summary["scenario"], summary["seed"]), (f"s, node {node}", node))
        frames = re.findall(r"^\((\d+\.\d+)\) can0 (\w{3})#(\w*)$", (a / "can.log").read_text(), re.M)
        sent = collections.Counter(int(identifier, 16) & 0x3F for _, identifier, _ in frames)
        self.assertEqual(set(sent), {1, 2, 3})
        self.assertLess(max(sent.values()) - min(sent.values()), 20)
        for (before_s, *_), (time_s, _, data) in itertools.pairwise(frames):
            shortest_s = (47 + 4 * len(data)) / 500e3  # two frames on one wire
            self.assertGreaterEqual(float(time_s) - float(before_s), shortest_s - 2e-6)

    def test_several_scenarios_are_boards_of_their_own_on_one_bus(self):
        noisy = SHORT + "sensor.position.noise_rms_m = 1e-5\n"
        kinds = {"single": noisy, "elbow": noisy + "[joint]\n", "lifter": noisy + "[bundle]\n"}
        for name, text in kinds.items():
            (self.path / f"{name}.toml").write_text(text)
        done = self.run_program("run", *(f"{name}.toml" for name in kinds), "--no-plot")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        out = self.path / "supercoil-out/single+elbow+lifter"
        self.assertEqual({path.name for path in out.iterdir()}, {"can.log", "node-1", "node-2", "node-4"})
        for name, node, before in (("single", 1, 0), ("elbow", 2, 1), ("lifter", 4, 3)):
            # As if it were alone with a seed of its own.
            (self.path / "alone.toml").write_text(f"simulation.seed = {1 + before}\n" + kinds[name])
            self.run_program("run", "alone.toml", "--out", f"alone-{node}", "--no-plot")
            self.assertEqual((out / f"node-{node}/trace.csv").read_bytes(), (self.path / f"alone-{node}/trace.csv").read_bytes())
            summary = json.loads((out / f"node-{node}/summary.json").read_text())
            self.assertEqual(summary["scenario"], f"{name}, node {node}")
        identifiers = re.findall(r" can0 (\w{3})#", (out / "can.log").read_text())
        lifter_channels = len({int(identifier, 16) & 0x3F for identifier in identifiers}) - 3
        self.assertEqual({int(identifier, 16) & 0x3F for identifier in identifiers}, set(range(1, 4 + lifter_channels)))
        self.assertGreater(lifter_channels, 1)

    def test_several_boards_files_have_the_nodes_that_they_say(self):
        example = (EXAMPLES / "raspberry-pi-pwm-ads1115.toml").read_text()
        joint = (EXAMPLES / "joint-as5600-ads1115.toml").read_text()
        (self.path / "a.toml").write_text(re.sub(r"first_node = \d+", "first_node = 5", example))
        (self.path / "b.toml").write_text(re.sub(r"first_node = \d+", "first_node = 20", joint))
        text = "simulation.rate_Hz = 100.0\n" + SHORT
        (self.path / "one.toml").write_text(text)
        (self.path / "two.toml").write_text(text + "[joint]\n")
        done = self.run_program("run", "one.toml", "two.toml", "--board", "a.toml", "--board", "b.toml", "--out", "out", "--no-plot")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual({path.name for path in (self.path / "out").iterdir()}, {"can.log", "node-5", "node-20"})

    def test_check_of_several_scenarios_tells_each(self):
        for name in "ab":
            (self.path / f"{name}.toml").write_text(SHORT)
        done = self.run_program("run", "a.toml", "b.toml", "--check")
        self.assertEqual(re.findall("(.*): in order", done.stdout), ["a.toml", "b.toml"])
        told = json.loads(self.run_program("run", "a.toml", "b.toml", "--check", "--json").stdout)
        self.assertEqual([each["scenario"] for each in told], ["a", "b"])

    def test_one_node_is_a_run_as_ever(self):
        for name, options in (("a", ()), ("b", ("--nodes", 1))):
            self.run_program("run", self.scenario(SHORT), "--out", name, *options)
        for name in ("trace.csv", "can.log", "plot.svg"):
            self.assertEqual((self.path / "a" / name).read_bytes(), (self.path / "b" / name).read_bytes())
        self.assertEqual(len(list((self.path / "b").iterdir())), 4)

    def test_a_node_that_failed_is_named(self):
        done = self.run_program("run", self.scenario(SHORT + "injected_fault.stop_pressed = true\n"), "--out", "out",
                                "--no-plot", "--no-trace", "--nodes", 2)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(re.findall(r"supercoil-sim: (s, node \d: never armed: fault 63)", done.stderr),
                         ["s, node 1: never armed: fault 63", "s, node 2: never armed: fault 63"])

    def test_every_no_trace_and_no_can(self):
        self.run_program("run", self.scenario(SHORT), "--out", "out", "--no-plot", "--every", 10)
        self.assertEqual(len((self.path / "out/trace.csv").read_text().splitlines()), 201)
        self.run_program("run", self.scenario(SHORT), "--out", "none", "--no-plot", "--no-trace",
                         "--no-can")
        self.assertEqual([p.name for p in (self.path / "none").iterdir()], ["summary.json"])

    def test_a_scenarios_muscle_under_the_firmware_of_a_boards_own_file(self):
        example = EXAMPLES / "raspberry-pi-pwm-ads1115.toml"
        text = "simulation.duration_s = 20.0\n"
        done = self.run_program("run", self.scenario(text), "--board", example, "--channel", 2, "--out", "out", "--no-plot")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        summary = json.loads((self.path / "out/summary.json").read_text())
        self.assertEqual((summary["controller"], summary["faults"]), ("pi", []))
        with (self.path / "out/trace.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 2000)  # at the board's 100 Hz
        # Its sensor counts 1.515 um.
        read_m = sorted({float(row["measured_m"]) for row in rows})
        steps_m = [after - before for before, after in zip(read_m, read_m[1:])]
        self.assertAlmostEqual(min(steps_m), 1.515e-6, delta=2e-9)
        self.assertGreater(len(steps_m), 100)

    def test_a_joint_under_the_firmware_of_a_boards_own_file(self):
        example = EXAMPLES / "joint-as5600-ads1115.toml"
        text = "simulation.duration_s = 120.0\nreference.amplitude_m = 0.002\n[joint]\n[[event]]\nat_s = 60.0\njoint.co_contraction_W = 1.8\n"
        done = self.run_program("run", self.scenario(text), "--board", example, "--out", "out", "--no-plot")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        summary = json.loads((self.path / "out/summary.json").read_text())
        self.assertEqual((summary["controller"], summary["faults"]), ("learned_ff", []))
        self.assertLess(summary["tracking_rms_deg"], 0.05)
        with (self.path / "out/trace.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 12000)  # at the board's 100 Hz

        # The file's 0.9 W of each, on so small a sine that neither is at 0 W; after the event what that says. It follows slowly.
        def both_W(begin_s, end_s):
            found = [float(row["applied_power_W"]) + float(row["antagonist_applied_power_W"]) for row in rows
                     if begin_s <= float(row["time_s"]) < end_s]
            return sum(found) / len(found)
        self.assertLess(abs(both_W(50.0, 60.0) - 1.8), 0.15)
        self.assertLess(abs(both_W(110.0, 120.0) - 3.6), 0.3)

    def test_each_muscle_of_a_joint_has_the_limits_of_its_own_channel(self):
        text = (EXAMPLES / "joint-as5600-ads1115.toml").read_text()
        last = 'current.device = "i2c-3/3-0049"\n'
        (self.path / "board.toml").write_text(text.replace(last, f"{last}limits.max_W = 2.0\n"))
        steps = "[reference]\nkind = 'steps'\nlevels_m = [0.007, -0.007]\nhold_s = 6.0\n"
        event = "[[event]]\nat_s = 0.5\njoint.load_Nm = 0.0001\n"  # which changes no limit
        for channel in (1, 2):
            done = self.run_program("run", self.scenario(f"simulation.duration_s = 24.0\n[joint]\n{steps}{event}"), "--board", "board.toml",
                                    "--channel", channel, "--out", "out", "--no-plot")
            with (self.path / "out/trace.csv").open(newline="") as file:
                rows = list(csv.DictReader(file))
            most_W = [max(float(row[key]) for row in rows) for key in ("applied_power_W", "antagonist_applied_power_W")]
            self.assertGreater(most_W[0], 3.0)
            self.assertLess(abs(most_W[1] - 2.0), 0.05)
            # Each muscle's limits are told, and the reference asked for more than this joint can do.
            limited = [sum(row[key] == "maximum" for row in rows) / len(rows) for key in ("limited_by", "antagonist_limited_by")]
            summary = json.loads((self.path / "out/summary.json").read_text())
            self.assertEqual([summary[key].get("maximum", 0) for key in ("limited_by_ratio", "antagonist_limited_by_ratio")], limited)
            self.assertGreater(limited[1], 0.1)
            self.assertGreater(summary["infeasible_ratio"], 0.95 * limited[1])  # not what is short
            self.assertIn(f"\nantagonist at a limit in {100 * sum(summary['antagonist_limited_by_ratio'].values()):.1f} % of the ticks: ", done.stdout)

    def test_a_joint_of_any_two_channels_of_a_boards_own_file(self):
        example = EXAMPLES / "joint-as5600-ads1115.toml"
        text = example.read_text()
        begin, end = text.index("[channel.position]"), text.index('[[channel]]                   # its')
        position = text[begin:end]
        swapped = text.replace(position, "").replace("[[joint]]", position + "[[joint]]")
        swapped = swapped.replace("agonist = 1 ", "agonist = 2 ").replace("antagonist = 2\n", "antagonist = 1\n")
        (self.path / "swapped.toml").write_text(swapped.replace("first_node = 1", "first_node = 5"))
        traces = []
        for board in (example, "swapped.toml"):
            done = self.run_program("run", self.scenario("simulation.duration_s = 5.0\n[joint]\n"), "--board", board, "--out", "out", "--no-plot")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            traces.append((self.path / "out/trace.csv").read_bytes())
        self.assertEqual(*traces)
        heard = {int(identifier, 16) & 0x3f for identifier in re.findall(r" can0 ([0-9A-F]+)#", (self.path / "out/can.log").read_text())}
        self.assertEqual(heard & {4, 5, 6, 7, 8}, {6, 7})

    def test_a_bundle_under_the_firmware_of_a_boards_own_file(self):
        text = (EXAMPLES / "joint-as5600-ads1115.toml").read_text()
        board = text[:text.index("[[joint]]")] + "[[bundle]]\nchannels = [1, 2]\n"
        (self.path / "board.toml").write_text(board)
        scenario = ("simulation.duration_s = 60.0\nplant.moving_mass_kg = 0.18\n[reference]\noffset_m = 0.004\namplitude_m = 0.002\n"
                    "[bundle.2]\nheat_transfer_W_per_K = 0.08\n")
        for channel in (1, 2):
            done = self.run_program("run", self.scenario(scenario), "--board", "board.toml", "--channel", channel, "--out", "out", "--no-plot")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            summary = json.loads((self.path / "out/summary.json").read_text())
            self.assertEqual((summary["controller"], summary["faults"], summary["ticks_outside_temperature_interval"]), ("learned_ff", [], 0))
            self.assertLess(summary["tracking_rms_m"], 100e-6)
            heard = {int(identifier, 16) & 0x3f for identifier in re.findall(r" can0 ([0-9A-F]+)#", (self.path / "out/can.log").read_text())}
            self.assertEqual(heard & {1, 2, 3}, {1, 2})

    def test_joints_on_one_bus_have_two_nodes_each(self):
        text = "simulation.duration_s = 2.0\n[joint]\n"
        # Each muscle has noise of its own: the second joint's begins behind the first one's two.
        self.run_program("run", self.scenario("simulation.seed = 3\n" + text), "--out", "alone", "--no-plot")
        done = self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--nodes", 2)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(*((self.path / name / "trace.csv").read_bytes() for name in ("alone", "out/node-3")))
        self.assertEqual(sorted(p.name for p in (self.path / "out").iterdir()), ["can.log", "node-1", "node-3"])
        heard = {int(identifier, 16) for identifier in re.findall(r" can0 ([0-9A-F]+)#", (self.path / "out/can.log").read_text())}
        self.assertEqual({identifier & 0x3F for identifier in heard}, {1, 2, 3, 4})

    def test_a_run_in_real_time_has_the_same_exit_status_where_something_is_asked_for(self):
        broken = "simulation.duration_s = 1.5\ninjected_fault.heater_open = true\n"
        for text, options, status in ((broken, [], 1), (broken, ["--allow-fault"], 0),
                                      ("simulation.duration_s = 0.5\n", [], 0),
                                      (broken + "operator.action = 'none'\n", [], 0)):
            done = self.run_program("run", self.scenario(text), "--real-time", "--out", "out", *options)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertEqual("fault 20 heater_open" in done.stderr, status == 1)

    def test_a_loop_that_oscillates_is_told_with_its_period(self):
        text = ("simulation.duration_s = 60.0\nplant.damping_Ns_per_m = 0.12\nmuscle.damping_Ns_per_m = 0.12\n"
                "controller = {kind = 'adaptive_ff', slow_when_oscillating = false}\n")
        done = self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--no-trace", "--no-can")
        summary = json.loads((self.path / "out/summary.json").read_text())
        self.assertAlmostEqual(summary["oscillation_period_s"], 0.5, delta=0.2)
        self.assertIn(f"with a period of {summary['oscillation_period_s']:.2g} s", done.stderr)

    def test_a_run_in_real_time_says_how_far_it_came(self):
        self.scenario("simulation.duration_s = 86400.0\n")
        running = subprocess.Popen([PROGRAM, "run", "s.toml", "--out", "out", "--real-time"], cwd=self.path,
                                   stdout=subprocess.PIPE, text=True)
        running.stdout.readline()
        time.sleep(0.5)
        running.send_signal(signal.SIGINT)
        told = running.communicate()[0]
        summary = json.loads((self.path / "out/summary.json").read_text())
        self.assertEqual(summary["window_s"][0], 0)
        self.assertAlmostEqual(summary["window_s"][1], summary["ticks"] / 1000)
        self.assertIn(f"\nended at {summary['ticks'] / 1000:g} s of 86400 s\n", told)
        self.assertIn(f"(0 to {summary['ticks'] / 1000:g} s)", told)

    def test_a_power_that_is_no_number_is_not_silent(self):
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

    def test_summary_says_what_was_run_and_which_results_belong_together(self):
        summary = self.summary_of(SHORT)
        version = self.run_program("--version").stdout.strip()
        self.assertEqual((summary["schema_version"], summary["program_version"], summary["seed"]), (4, version, 1))
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

    def test_summary_has_the_share_of_ticks_at_each_limit(self):
        summary = self.summary_of(SHORT + "power.max_W = 0.01\n")
        self.assertGreater(summary["limited_by_ratio"]["maximum"], 0.5)
        self.assertLessEqual(sum(summary["limited_by_ratio"].values()), 1.0)
        self.assertNotIn("nothing", summary["limited_by_ratio"])

    def test_check_and_list_write_nothing(self):
        checked = self.run_program("run", self.scenario(SHORT), "--check")
        self.assertEqual(checked.returncode, 0)
        self.assertIn("in order", checked.stdout)
        self.assertRegex(checked.stdout, r"\nmuscle: holds [\d.]+ mm for good, at [\d.]+ W")
        self.assertRegex(checked.stdout, r"\nmuscle: controller 0 promises no error \(mrac\); the recommended one promises, once "
                                         r"the muscle is identified, at most [\d.]+ um rms on a sine of")
        self.assertRegex(checked.stdout, r"\nmuscle: controller 0: once adapted margin 0\.\d+, holds if no parameter moves by more than")
        listed = self.run_program("list")
        self.assertIn("sine", listed.stdout)
        self.assertIn("printed", listed.stdout)
        self.assertIn("joint          Two real muscles that differ by a tenth turn a joint by 20 degrees either way; after a minute a weight hangs on its arm.\n", listed.stdout)
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
