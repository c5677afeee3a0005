"""supercoil setup as a newcomer meets it: a file that is completed, what is taken back, errors."""

import json
import re
import subprocess
import unittest

from live import DEADLINE_S
from setup_case import ANSWERS, EXAMPLE, RESTART, SUPERCOIL, SUPERCOILD, SetupCase, Terminal


class SetupProgram(SetupCase):
    def test_describe_completes_the_board_file_and_keeps_comments(self):
        done = self.describe()
        self.assertIn("stiffness_N_per_m = 17.84  (stretch_weight_g and stretch_mm)", done.stdout)
        lines = re.findall("^  (holds .*|may be armed .*|controller 0.*)$", done.stdout, re.M)
        self.assertRegex(lines[2], r"controller 0: margin 0\.\d+, holds if no parameter is off by more than \d+ %, bandwidth 7\.\d+ rad/s")
        text = self.board.read_text()
        for line in self.example.splitlines():
            self.assertIn(line, text)
        checked = subprocess.run([SUPERCOILD, "--check", self.board], capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("0: learned_ff", checked.stdout)
        for line in lines:
            self.assertIn(f" {line}\n", checked.stdout)
        self.assertIn("describe", json.loads(self.record.read_text())["channel-1"])
        self.assertEqual((self.path / "board.toml.before-setup").read_text(), self.example)

    def test_output_that_cannot_be_written_is_an_error(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([SUPERCOIL, "setup", "describe", "--config", self.board, *self.script()], stdout=full,
                                  stderr=subprocess.PIPE, text=True, timeout=DEADLINE_S)
        self.assertEqual((done.returncode, done.stderr), (1, "supercoil: cannot write to standard output\n"))

    def test_a_script_is_notified_that_the_board_must_restart(self):
        done = self.setup_program(*self.script(), "--json")
        self.assertEqual((done.returncode, json.loads(done.stdout)["restart_board"]), (RESTART, True))
        self.assertIn("start the board with it, and run setup again to go on", done.stderr)
        # When a step is named, only that one is run.
        done = self.setup_program("describe", *self.script(), "--json")
        self.assertEqual((done.returncode, json.loads(done.stdout)["restart_board"]), (0, False))

    def test_asks_without_a_script_and_repeats_after_an_invalid_answer(self):
        lines = [str(value) for value in ANSWERS.values()]
        questions = ["", "10 Ohm", *lines[:7], "", "22.5", *lines[8:10], ""]  # by a thermometer instead of the weight
        done = self.setup_program("describe", input="\n".join(questions) + "\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Resistance of the cold muscle, by an ohmmeter, in Ohm (0.1 to 10000): '10 Ohm' is refused", done.stdout)
        self.assertIn("wrong, in % (1 to 60) [50]: ", done.stdout)
        self.assertIn("max_travel_m = 0.025", done.stdout)

    def test_invalid_answers_are_refused_at_once_and_earlier_ones_offered(self):
        # By a thermometer, as thread_g is not known: then heated_K must be.
        typed = ["", "10", "90", "100", "55", "2", "13", "1.3", "0", "", "0", "22.5", "200", "11.7"]
        with Terminal("describe", "--config", self.board) as terminal:
            for text in (*typed, "11.665", "30"):  # four slips for max_W
                terminal.answer(text)
            terminal.until(r"(?s)(11\.664\): .*){5}$")
            self.assertIn("by a thermometer, in K; needed, as thread_g is not known (0.1 to 200): ", terminal.output)
            self.assertEqual(terminal.output.count("'' is refused: it must be a number from 0.1 to 200"), 1)
            self.assertEqual(terminal.output.count("no more than the supply can give it (0.001 to 11.664): "), 5)
            terminal.answer("4.5")
            terminal.until(r"no more than its sensor can read \(0\.01 to 41\): $")
            terminal.type("\x03")
            self.assertEqual(terminal.ended(), 1)
        self.assertTrue(terminal.output.endswith("41): ^C\r\nsupercoil: interrupted\r\n"), terminal.output[-200:])
        self.assertEqual(self.board.read_text(), self.example)
        self.assertEqual(self.setup_program("describe", input="\n" * 11 + "25\n\n").returncode, 0)
        text = self.board.read_text()
        for line in ("cold_resistance_Ohm = 10", "max_W = 4.5", "max_travel_m = 0.025", "stiffness_N_per_m = 17.84"):
            self.assertIn(line, text)
        self.assertEqual(json.loads(self.record.read_text())["answers"]["channel-1"]["heated_K"], 22.5)
        self.assertEqual(self.setup_program("--undo").returncode, 0)
        done = self.setup_program("describe", input="\n12\n" + "\n" * 11)  # one correction
        self.assertIn("in Ohm (0.1 to 10000) [10]: ", done.stdout)
        self.assertIn("cold_resistance_Ohm = 12", self.board.read_text())

    PLATE = {"rated_W": 2, "rated_Ohm": 10, "length_mm": 150, "stroke_percent": 8, "stroke_load_g": 90, "max_C": 120}

    def test_a_nameplate_supplies_the_rated_values(self):
        measured = {key: None for key in ANSWERS} | {"stretch_weight_g": 100, "stretch_mm": 55, "half_cooling_s": 1.3}
        _, script = self.script(**measured)
        script.write_text(script.read_text() + "[nameplate]\n" + "".join(f"{key} = {value}\n" for key, value in self.PLATE.items()))
        self.describe("--script", script)
        by_script = self.board.read_text()
        for line in ("cold_resistance_Ohm = 10", "max_W = 2", "max_travel_m = 0.012", "trip_C = 120", "derate_from_C = 101",
                     "heat_transfer_W_per_K = 0.02105", "moving_mass_kg = 0.09"):
            self.assertIn(line, by_script)
        checked = subprocess.run([SUPERCOILD, "--check", self.board], capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        # Asked one after the other the same is offered, and Enter keeps it.
        self.setup_program("--undo")
        self.record.unlink(missing_ok=True)
        typed = ["1", *map(str, self.PLATE.values()), "", "", "100", "55", "", "", "1.3", "", "", "", "", ""]
        done = self.setup_program("describe", input="\n".join(typed) + "\n")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("Rated continuous power, in W (0.001 to 1000): ", done.stdout)
        self.assertIn("in mm (0.01 to 10000) [12]: ", done.stdout)
        self.assertEqual(self.board.read_text(), by_script)

    def test_every_nameplate_value_is_required(self):
        _, script = self.script()
        script.write_text(script.read_text() + "[nameplate]\nrated_W = 2\nstroke = 8\n")
        self.assert_refused(self.setup_program("--script", script), "nameplate.rated_Ohm", "nameplate.stroke", "did you mean stroke_")

    def test_a_nameplate_that_this_board_does_not_allow_is_named(self):
        measured = {key: None for key in ANSWERS} | {"stretch_weight_g": 100, "stretch_mm": 55, "half_cooling_s": 1.3}
        for rated, wrong in (({"max_C": 40}, "nameplate.max_C = 40: must be 0, if it is not given, or 50 to 180: no muscle moves below"),
                             ({"length_mm": 9000, "stroke_percent": 60}, "muscle.max_travel_mm = 5400 by [nameplate]: must be 0.01 to 41 here"),
                             ({"rated_W": 30}, "muscle.max_W = 30 by [nameplate]: must be 0.001 to 11.66")):
            _, script = self.script(**measured)
            script.write_text(script.read_text() + "[nameplate]\n"
                              + "".join(f"{key} = {value}\n" for key, value in (self.PLATE | rated).items()))
            with self.subTest(rated):
                self.assert_refused(self.setup_program("--script", script), f"{script}: {wrong}")
        typed = ["1", *map(str, (self.PLATE | {"max_C": 40}).values()), "120"]
        done = self.setup_program("describe", input="\n".join(typed) + "\n")
        self.assertIn("  max_C = 40: must be 0, if it is not given, or 50 to 180", done.stdout)
        self.assertIn("in Ohm (0.1 to 10000) [10]: ", done.stdout)

    def test_implausible_answers_are_refused_and_kept(self):
        questions = ["", "10", "0.1", "1e6", "0.01", "2", "13", "1.3", "0.1", "", "4.5", "25", ""]
        done = self.setup_program("describe", input="\n".join(questions) + "\n")
        self.assertEqual(done.returncode, 2)
        self.assertIn("stretch_weight_g and stretch_mm give a muscle with ", done.stderr)
        self.assertIn(f"the answers are kept: supercoil setup describe --config {self.board} offers them again", done.stdout)
        self.assertEqual(self.board.read_text(), self.example)
        self.assertNotRegex(self.setup_program(*self.script(max_W=40)).stderr, r"board\.toml:\d")

    def test_without_answers_nothing_changes(self):
        self.assert_refused(self.setup_program(stdin=subprocess.DEVNULL), "no answer: the input has ended")

    def test_every_invalid_answer_is_reported_with_its_range(self):
        self.assert_refused(self.setup_program(*self.script(load_g=None, stretch_mm=None)),
                            "muscle.load_g: is missing: Weight that it lifts", "muscle.stretch_mm: is missing")
        self.assert_refused(self.setup_program(*self.script(load_g=0)), "muscle.load_g = 0", "0.1 to 1e+06")
        self.assert_refused(self.setup_program(*self.script(take_gains=2)), "muscle.take_gains = 2", "0 to 1")
        self.assert_refused(self.setup_program(*self.script(lode_g=3)), "muscle.lode_g", "did you mean load_g?")
        script = self.script(thread_g=0)
        self.assert_refused(self.setup_program(*script), f"{script[1]}: thread_g or heated_K must be known")
        self.assert_refused(self.setup_program(*self.script("[senses]\npower_W = 0.1\nsupply_V = [12.0]\ncurrent_A = [0.004, 0]")),
                            "answers.toml:15: senses.supply_V", "2 numbers", "senses.current_A", "1e-05 to 1000")
        self.assert_refused(self.setup_program(*self.script("[limits]\nstop_m = 0.008")), "limits.stop_m", "did you mean stop_mm?")
        self.assert_refused(self.setup_program(*self.script("[scale]")), "scale.place_mm: is missing")
        self.assert_refused(self.setup_program("--script", "missing.toml"), "missing.toml")
        self.assert_refused(self.setup_program("--channel", "3", *self.script()), "board.toml has no channel 3, but 2")
        self.assertEqual(self.setup_program("--channel", "3", input="10\n").stdout, "")  # before anything is asked
        self.assert_refused(self.setup_program("calibrat"), "did you mean calibrate?")

    def test_values_beyond_the_board_are_refused_by_key(self):
        self.assert_refused(self.setup_program(*self.script(max_W=40, max_travel_mm=50)),
                            "answers.toml:10: muscle.max_W = 40: must be 0.001 to 11.664 here: Maximum power", "no more than the supply can give it",
                            "answers.toml:11: muscle.max_travel_mm = 50: must be 0.01 to 41 here: ")

    def test_a_configured_list_of_controllers_is_kept(self):
        self.board.write_text((EXAMPLE.parent / "on-chip-pwm-fast-converter.toml").read_text())
        done = self.describe()
        text = self.board.read_text()
        self.assertIn('kind = "mrac"', text)
        self.assertNotIn("learned_ff", text)
        self.assertIn("limits = { max_W = 4.5, max_travel_m = 0.025, energy_J = 200.0 }", text)

    def test_an_invalid_file_is_reported_before_any_question(self):
        self.board.write_text("[[channel\n")
        done = self.setup_program(stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 2)
        self.assertIn("board.toml:1: ", done.stderr)
        self.assertNotIn("Resistance", done.stdout)

    def test_a_joints_range_is_narrowed(self):
        joint = (EXAMPLE.parent / "joint-as5600-ads1115.toml").read_text()
        joint = re.sub("\nmax_travel_m = .*", "", joint).replace("lever_m = 0.015", "lever_m = 0.015\nrange_deg = [-30, 28]  # stops")
        self.board.write_text(joint)
        bench = {"heated_mm": 6.5, "stretch_mm": 30}
        done = self.setup_program("describe", *self.script(**bench, max_travel_mm=5))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("joint.range_deg = [-30, 19.09]  (as answered)", done.stdout)
        self.assertIn("range_deg = [-30, 19.09]  # stops", self.board.read_text())
        self.assertNotIn("max_travel_m", self.board.read_text())
        done = self.setup_program("describe", "--channel", "2", *self.script(**bench, max_travel_mm=8))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("its travel stays as set by its joint's range_deg: 7.854 mm", done.stdout)
        self.assertIn("range_deg = [-30, 19.09]  # stops", self.board.read_text())
        checked = subprocess.run([SUPERCOILD, "--check", self.board], capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_a_muscle_against_gravity_is_described_with_the_weight(self):
        self.board.write_text(self.example.replace("\nmax_travel_m = 0.025", "") + "\n[channel.limits]\nmax_travel_m = 0.025\n" +
                              '[[joint]]\nopposed_by = "gravity"\nagonist = 1\nlever_m = 0.015\nrange_deg = [0, 60]\n'
                              "weight_Nm = 0.002\nhangs_at_deg = -45\n")
        done = self.setup_program("describe", *self.script(max_travel_mm=5))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("it turns a joint: answer for this muscle moving the joint against what draws it back. Hang weights at", done.stdout)
        self.assertIn("joint.range_deg = [0, 19.09]  (as answered)", done.stdout)
        checked = subprocess.run([SUPERCOILD, "--check", self.board], capture_output=True, text=True, timeout=DEADLINE_S)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertRegex(checked.stdout, r"the weight pulls the cold muscle with 0\.0943 N; held at 4\.77° with ")

    def test_doctor_checks_this_machine_or_names_the_right_one(self):
        done = self.setup_program("doctor", "--socket", self.path / "commands", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)["steps"]["doctor"]
        self.assertEqual(found["looked_at"], "two muscles")
        self.assertGreater(found["problems"], 0)
        self.assertRegex(done.stderr, r"\n  problem: [^\n]+\n  what to do: ")
        self.assertIn(f"\n  {found['problems']} problem", done.stderr)
        self.assertNotIn("\n  ok", done.stderr)
        done = self.setup_program("doctor", "--can", "socketcand:1", "--json")
        self.assertEqual((done.returncode, json.loads(done.stdout)["steps"]), (0, {"doctor": {"looked_at": None}}))
        self.assertIn("is simulated, or another machine", done.stderr)
        self.assertIn("run supercoil doctor on the board", done.stderr)
        self.setup_program(*self.script())
        resumed = self.setup_program("--can", "socketcand:1")
        self.assertEqual(re.findall(r"^(\w+): ", resumed.stdout, re.M)[:2], ["doctor", "senses"])

    def files(self):
        return sorted(path.name.removeprefix("board.toml") for path in self.path.glob("board.toml*"))

    def test_undo_restores_the_file_and_keeps_the_replaced_one(self):
        self.setup_program(*self.script())
        described = self.board.read_text()
        self.assertNotEqual(described, self.example)
        done = self.setup_program("--undo")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, f"{self.board} is as it was before describe of channel 1, and that step and all later ones "
                         f"must be repeated; the file as it was until now is kept as {self.board}.undone\n")
        self.assertEqual(self.board.read_text(), self.example)
        self.assertEqual(self.files(), ["", ".undone"])
        self.assertEqual((self.path / "board.toml.undone").read_text(), described)
        again = self.setup_program("--undo")
        self.assertEqual(again.returncode, 1)
        self.assertIn("setup has changed nothing", again.stderr)

    def test_undo_reverts_changes_in_order_and_per_channel(self):
        self.setup_program(*self.script())
        self.setup_program("describe", *self.script(max_W=3))
        both = self.board.read_text()
        self.assertIn("max_W = 3", both)
        self.setup_program("describe", *self.script(max_W=3))  # changes nothing
        self.setup_program("describe", "--channel", "2", *self.script())
        done = self.setup_program("--undo")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the last change was describe of channel 2: undo that first with --channel 2 --undo", done.stderr)
        self.assertEqual(self.setup_program("--undo", "--channel", "2").returncode, 0)
        self.assertEqual(self.board.read_text(), both)
        done = self.setup_program("--undo", "--json")
        self.assertEqual(json.loads(done.stdout), {"file": str(self.board), "channel": 1, "step": "describe",
                                                   "kept_as": f"{self.board}.undone-2", "on_board": []})
        self.assertIn("max_W = 4.5", self.board.read_text())
        self.setup_program("--undo")
        self.assertEqual(self.board.read_text(), self.example)
        self.assertFalse(self.record.exists())

    def test_undo_lists_what_stays_on_the_board(self):
        self.setup_program(*self.script())
        record = json.loads(self.record.read_text())

        def undone(*arguments, **steps):
            self.setup_program("describe", *self.script(max_W=3))
            self.record.write_text(json.dumps({**json.loads(self.record.read_text()), "channel-1": {**record["channel-1"], **steps}}))
            return self.setup_program("--undo", *arguments)

        done = undone(senses={}, calibrate={}, identify={}, gains={"taken": True}, move={})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(done.stdout.endswith(
            "\nthe board keeps, from start to start, what was found of the muscle (supercoil command 1 clear forgets it); "
            "the tuning that gains stored (supercoil tune 1 --clear forgets it); "
            "the comparison with a meter (supercoil command 1 compare_supply 0 forgets it)\n"), done.stdout)
        self.assertNotIn("on the board", undone(gains={"taken": False}).stdout)
        self.assertEqual(json.loads(undone("--json", "--can", "can0", scale={}).stdout)["on_board"],
                         [{"what": "what was found of the muscle", "forgotten_by": "supercoil command 1 clear --can can0"}])

    def test_undo_keeps_edits_by_hand(self):
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

    def test_on_a_terminal_undo_asks_about_edits_by_hand(self):
        self.setup_program(*self.script())
        self.board.write_text(self.board.read_text() + "# by hand\n")
        for answer, left in (("0", True), ("1", False)):
            with Terminal("--config", self.board, "--undo") as terminal:
                terminal.until("undo it anyway, 0: leave it")
                terminal.type(answer + "\n")
                self.assertEqual(terminal.ended(), 1 if left else 0, terminal.output)
            self.assertEqual("# by hand" in self.board.read_text(), left)

    def test_undo_needs_its_record(self):
        self.setup_program(*self.script())
        described = self.board.read_text()
        self.record.unlink()
        done = self.setup_program("--undo", "--force")
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"{self.board}.before-setup is the file as it was before", done.stderr)
        self.assertEqual(self.board.read_text(), described)

    def test_errors_are_reported_in_json_too(self):
        self.record.write_text("{")
        done = self.setup_program("calibrate", "--json")
        self.assertEqual(done.returncode, 1)
        result = json.loads(done.stdout)
        self.assertEqual(result["steps"], {})
        self.assertIn("is damaged", result["error"])
        self.assertEqual(done.stderr, f"supercoil: {result['error']}\n")


if __name__ == "__main__":
    unittest.main()
