"""supercoil-sim with the firmware configured by boards' own files, and with several boards on one bus."""

import collections
import csv
import itertools
import json
import re
import unittest

from sim_program import EXAMPLES, SHORT, ProgramCase


class Boards(ProgramCase):
    def test_nodes_are_boards_of_their_own_on_one_bus(self):
        noisy = SHORT + "sensor.position.noise_rms_m = 1e-5\n"
        for name in "ab":
            self.run_program("run", self.scenario(noisy), "--out", name, "--nodes", 3)
        a, b = self.path / "a", self.path / "b"
        self.assertEqual({str(file.relative_to(a)) for file in a.rglob("*.*")}, {"can.log", *(
            f"node-{node}/{name}" for node in (1, 2, 3) for name in ("trace.csv", "plot.svg", "summary.json"))})
        self.assertEqual((a / "can.log").read_bytes(), (b / "can.log").read_bytes())
        for node in (1, 2, 3):
            # As if it were alone with its own seed.
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
            # As if it were alone with its own seed.
            (self.path / "alone.toml").write_text(f"simulation.seed = {1 + before}\n" + kinds[name])
            self.run_program("run", "alone.toml", "--out", f"alone-{node}", "--no-plot")
            self.assertEqual((out / f"node-{node}/trace.csv").read_bytes(), (self.path / f"alone-{node}/trace.csv").read_bytes())
            summary = json.loads((out / f"node-{node}/summary.json").read_text())
            self.assertEqual(summary["scenario"], f"{name}, node {node}")
        identifiers = re.findall(r" can0 (\w{3})#", (out / "can.log").read_text())
        lifter_channels = len({int(identifier, 16) & 0x3F for identifier in identifiers}) - 3
        self.assertEqual({int(identifier, 16) & 0x3F for identifier in identifiers}, set(range(1, 4 + lifter_channels)))
        self.assertGreater(lifter_channels, 1)

    def test_the_limits_of_each_of_several_muscles_have_its_name(self):
        for name, force in (("strong", 0.2), ("weak", 0.1)):
            (self.path / f"{name}.toml").write_text(SHORT + f"plant.force_per_kelvin_N_per_K = {force}\n")
        together = self.run_program("run", "strong.toml", "weak.toml", "--no-plot").stdout
        blocks = re.split(r"^(\w+, node \d):\n", together, flags=re.M)[1:]
        self.assertEqual(blocks[::2], ["strong, node 1", "weak, node 2"])
        for name, block in zip(("strong", "weak"), blocks[1::2]):
            alone = self.run_program("run", f"{name}.toml", "--no-plot").stdout
            self.assertNotIn(", node", alone)
            self.assertTrue(block.startswith(alone[:alone.index(f"{name}: ")]))

    def test_several_board_files_have_their_configured_nodes(self):
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

    def test_check_of_several_scenarios_reports_each(self):
        for name in "ab":
            (self.path / f"{name}.toml").write_text(SHORT)
        done = self.run_program("run", "a.toml", "b.toml", "--check")
        self.assertEqual(re.findall("(.*): in order", done.stdout), ["a.toml", "b.toml"])
        reports = json.loads(self.run_program("run", "a.toml", "b.toml", "--check", "--json").stdout)
        self.assertEqual([each["scenario"] for each in reports], ["a", "b"])

    def test_one_node_is_an_ordinary_run(self):
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

    def test_the_air_has_a_sensor_if_the_boards_file_has_one(self):
        example = (EXAMPLES / "raspberry-pi-pwm-ads1115.toml").read_text()
        sensor = ('[ambient.sensor]\ndevice = "i2c-1/1-004a"\ninput = "voltage1"\nbus = "i2c-1"\n'
                  "C_per_count = 0.01\nerror_K = 3.0\n")
        (self.path / "without.toml").write_text(example)
        (self.path / "with.toml").write_text(example.replace("\n[can]", f"\n{sensor}\n[can]", 1))
        air = ("simulation.duration_s = 0.1\noperator.action = 'none'\n"
               "ambient = {air_C = 20.0, sensor_error_K = 1.5, sensor_offset_K = 0.5}\n")
        hottest_K = []
        for board in ("without", "with"):
            done = self.run_program("run", self.scenario(air), "--board", f"{board}.toml", "--out", "out", "--no-plot")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            with (self.path / "out/trace.csv").open(newline="") as file:
                hottest_K.append(float(next(csv.DictReader(file))["hottest_K"]))
        # From the file's warmest air, 30 degrees, or from the sensor's reading and its error, 20.5 and 3.
        self.assertAlmostEqual(hottest_K[0] - hottest_K[1], 30.0 - 23.5, delta=0.5)

    def test_power_and_sensor_of_the_scenario_are_not_checked_where_a_boards_own_file_has_others(self):
        example = EXAMPLES / "raspberry-pi-pwm-ads1115.toml"
        for text in ("power = {max_W = 20.0}\n", "power.pwm_bits = 3\n", "sensor.position.range_m = 0.015\n"):
            self.assertEqual(self.run_program("run", self.scenario(text), "--check").returncode, 2)
            done = self.run_program("run", self.scenario(text), "--check", "--board", example)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

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

        # 0.9 W each from the file, and a sine so small that neither reaches 0 W; then the event's power, which it follows slowly.
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
        event = "[[event]]\nat_s = 0.5\njoint.load_Nm = 0.0001\n"  # does not change any limit
        for channel in (1, 2):
            done = self.run_program("run", self.scenario(f"simulation.duration_s = 24.0\n[joint]\n{steps}{event}"), "--board", "board.toml",
                                    "--channel", channel, "--out", "out", "--no-plot")
            with (self.path / "out/trace.csv").open(newline="") as file:
                rows = list(csv.DictReader(file))
            most_W = [max(float(row[key]) for row in rows) for key in ("applied_power_W", "antagonist_applied_power_W")]
            self.assertGreater(most_W[0], 3.0)
            self.assertLess(abs(most_W[1] - 2.0), 0.05)
            # The limits of each muscle are reported, and the reference asked for more than this joint can do.
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
        sent = {int(identifier, 16) & 0x3f for identifier in re.findall(r" can0 ([0-9A-F]+)#", (self.path / "out/can.log").read_text())}
        self.assertEqual(sent & {4, 5, 6, 7, 8}, {6, 7})

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
            sent = {int(identifier, 16) & 0x3f for identifier in re.findall(r" can0 ([0-9A-F]+)#", (self.path / "out/can.log").read_text())}
            self.assertEqual(sent & {1, 2, 3}, {1, 2})

    def test_joints_on_one_bus_have_two_nodes_each(self):
        text = "simulation.duration_s = 2.0\n[joint]\n"
        # Each muscle has its own noise: the second joint's seeds follow the two of the first joint.
        self.run_program("run", self.scenario("simulation.seed = 3\n" + text), "--out", "alone", "--no-plot")
        done = self.run_program("run", self.scenario(text), "--out", "out", "--no-plot", "--nodes", 2)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(*((self.path / name / "trace.csv").read_bytes() for name in ("alone", "out/node-3")))
        self.assertEqual(sorted(p.name for p in (self.path / "out").iterdir()), ["can.log", "node-1", "node-3"])
        sent = {int(identifier, 16) for identifier in re.findall(r" can0 ([0-9A-F]+)#", (self.path / "out/can.log").read_text())}
        self.assertEqual({identifier & 0x3F for identifier in sent}, {1, 2, 3, 4})


if __name__ == "__main__":
    unittest.main()
