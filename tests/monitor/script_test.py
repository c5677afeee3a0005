"""supercoil command and supercoil setting over a bus, as scripts use them.

Programs: environment SUPERCOIL and SUPERCOIL_SIM, otherwise those of build/release.
"""

import json
import pathlib
import re
import signal
import subprocess
import tempfile
import unittest

from programs import OnSimulatedBoard, ROOT, SLACK_S, SUPERCOIL, command, simulated_board, until


class Scripts(OnSimulatedBoard):
    def command(self, *words):
        return command(self.source, *words)

    def arm_by_script(self):
        for word in ("disarm", "reset"):
            self.command("1", word)
        until(lambda: self.command("1", "arm").returncode == 0)

    def test_heating_commands_may_follow_arm_at_once(self):
        for _ in range(8):
            self.arm_by_script()
            done = self.command("1", "power", "0.1")
            self.assertNotIn("busy", done.stderr)

    def test_state_is_available_as_json(self):
        self.arm_by_script()
        node, = json.loads(self.command("state", "--json").stdout)["nodes"]
        self.assertEqual((node["node"], node["Status"]["state"], node["Status"]["fault"]), (1, "armed", "none"))
        self.assertEqual((node["Status"]["controller"], node["controller_kind"]), (0, "mrac"))
        self.assertIn("node 1: armed, rest, mrac (controller 0), off;", self.command("state").stdout)
        self.assertAlmostEqual(node["Measurement"]["position_m"], 0.0, delta=1e-3)
        self.assertIsNone(node["Tracking"]["error_m"])
        self.assertEqual(sum(name.startswith("theta") and not name.endswith("deviation") for name in node["Estimate"]), 4)

    def test_errors_are_reported_in_json_too(self):
        for words, status, expected in ((("command", "64", "arm", "--can", self.source), 2, "node '64': must be 1 to 63"),
                                    (("command",), 2, "COMMAND is required"),
                                    (("command", "", "--can", self.source), 2, "no command: it must be state, or a node and a command"),
                                    (("command", "status", "--can", self.source), 2, "'status': must be state, or a node, as in '1 arm'"),
                                    (("command", "1 amr", "--can", self.source), 2, "did you mean arm?"),
                                    (("command", "1", "identify", "--for", "0", "--can", self.source), 2, "--for: 0: must be more than 0"),
                                    (("tune", "99"), 2, "not in range"),
                                    (("tuen", "1"), 2, "did you mean tune?"),
                                    (("command", "state", "1", "--can", self.source), 2, "state 1: state covers all channels: leave out '1'"),
                                    (("command", "1", "amr", "--can", self.source), 2, "did you mean arm?"),
                                    (("command", "1", "arm", "1", "--can", self.source), 2, "arm takes no value: leave out '1'"),
                                    (("command", "1", "position", "--can", self.source), 2, "position needs a number, in m"),
                                    (("command", "2", "arm", "--can", self.source), 1, "no answer from node 2"),
                                    (("command", "state", "--can", "socketcand:1"), 1, "socketcand"),
                                    (("command", "1", "arm", "--amplitude", "1", "--period", "2", "--can", self.source), 2, "a sine"),
                                    (("command", "1", "position", "5deg", "--can", self.source), 2, "node 1 is in no joint"),
                                    (("command", "0", "position", "5deg", "--can", self.source), 2, "node '0': must be 1 to 63"),
                                    (("command", "1", "power", "-1", "--can", self.source), 2, "power must be 0 W or more"),
                                    (("command", "1", "power", "1", "--amplitude", "1.5", "--period", "2", "--for", "3", "--can", self.source), 2,
                                     "1 power 1 --amplitude 1.5: power must be 0 W or more"),
                                    (("command", "1", "arm", "--for", "3", "--can", self.source), 2,
                                     "1 arm --for: nothing to renew; it applies to position, power, renew, identify and calibrate"),
                                    (("command", "state", "--hold", "--can", self.source), 2, "state --hold: nothing to renew"),
                                    (("command", "1", "positon", "0", "--hold", "--can", self.source), 2, "did you mean position?"),
                                    (("--foo",), 2, "--foo is not an option; --help lists those that there are"),
                                    (("tune", "--foo"), 2, "--foo is not an option; --help lists those that there are"),
                                    (("doctor", "--confg", "board.toml"), 2, "--confg is not an option; did you mean --config?"),
                                    (("doctor", "board.toml"), 2, "'board.toml' is one argument too many; --help lists those that are expected"),
                                    (("command", "2", "position", "5deg", "--can", self.source), 1, "no answer from node 2"),
                                    (("command", "1", "power", "5deg", "--can", self.source), 2, "power needs a number"),
                                    (("command", "1", "power", "1deg", "--amplitude", "1", "--period", "2", "--for", "5", "--can", self.source), 2,
                                     "a sine needs a number"),
                                    (("command", "1", "position", "5deg", "--amplitude", "0.0005", "--period", "5", "--for", "5", "--can", self.source), 2,
                                     "1 position 5deg --amplitude 0.0005: both must have the same unit"),
                                    (("command", "1", "position", "0.005", "--amplitude", "3°", "--period", "5", "--for", "5", "--can", self.source), 2,
                                     "1 position 0.005 --amplitude 3°: both must have the same unit"),
                                    (("command", "1", "position", "5deg", "--amplitude", "3rad", "--period", "5", "--for", "5", "--can", self.source), 2,
                                     "--amplitude 3rad: must be a number of degrees, such as 3deg"),
                                    (("command", "1", "position", "5deg", "--amplitude", "3deg", "--period", "5", "--for", "5", "--can", self.source), 2,
                                     "node 1 is in no joint"),
                                    (("setting", "1", "volume", "--can", self.source), 2, "is not a setting"),
                                    (("setting", "2", "--can", self.source), 1, "no answer from node 2"),
                                    (("doctor", "--config", "/dev/null"), 2, "is not a file"),
                                    (("identify", "/dev/null"), 2, "/dev/null")):
            done = subprocess.run([SUPERCOIL, *words, "--json"], capture_output=True, text=True, timeout=SLACK_S)
            answer = json.loads(done.stdout)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertIn(expected, answer["error"])
            self.assertIn(expected, done.stderr)

    def test_reports_how_calibrate_ended(self):
        for words in (("--for", "60"), ()):  # without a time it is renewed until it ends
            self.arm_by_script()
            done = self.command("1", "calibrate", "--json", *words)
            self.assertEqual((done.returncode, json.loads(done.stdout)), (0, {"command": "1 calibrate", "result": "found"}))
        self.command("1", "disarm")
        refused = self.command("1", "identify", "--json")
        self.assertEqual((refused.returncode, json.loads(refused.stdout)), (1, {"command": "1 identify", "answer": "refused: wrong_state"}))

    def test_reports_an_interrupted_calibrate(self):
        self.arm_by_script()
        # A warm muscle must cool first: long enough to be seen.
        until(lambda: self.command("1", "power", "2.5", "--for", "3").returncode == 0)
        held = subprocess.Popen([SUPERCOIL, "command", "1", "calibrate", "--for", "60", "--can", self.source],
                                stderr=subprocess.PIPE, text=True)
        until(lambda: "node 1: active, calibrate" in self.command("state").stdout)
        self.assertIsNone(held.poll())
        self.command("1", "disarm")
        self.assertEqual((held.communicate(timeout=SLACK_S)[1], held.returncode),
                         ("supercoil: 1 calibrate ended: interrupted, disarmed\n", 1))
        self.assertIn("calibration: interrupted", self.command("state").stdout)

    def identify_by_script(self, *words, meanwhile=lambda program: None):
        """The exit status and the texts."""
        self.arm_by_script()
        program = subprocess.Popen([SUPERCOIL, "command", "1", "identify", *words, "--can", self.source],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        meanwhile(program)
        out, err = program.communicate(timeout=60)
        return program.returncode, out, err

    def test_an_interrupted_identify_fails(self):
        ended = "supercoil: 1 identify ended: interrupted, by "
        self.assertEqual(self.identify_by_script("--for", "2", "--json"),
                         (1, '{"command":"1 identify","result":"interrupted","cause":"by the end of --for"}\n', ended + "the end of --for\n"))

        for words, by, cause in ((("--hold",), signal.SIGINT, "Ctrl-C"), ((), signal.SIGINT, "Ctrl-C"), ((), signal.SIGTERM, "SIGTERM"), ((), signal.SIGHUP, "SIGHUP")):
            def interrupt(program, by=by):
                until(lambda: program.poll() is not None or "node 1: active, identify" in self.command("state").stdout)
                program.send_signal(by)

            self.assertEqual(self.identify_by_script(*words, meanwhile=interrupt), (1, "", ended + cause + "\n"))

    def test_a_refused_value_names_the_nearest_accepted_one(self):
        refused = self.command("1", "controller", "77")
        nearest = re.search(r"refused: out_of_range; (\d+) would be obeyed", refused.stderr)
        self.assertTrue(nearest, refused.stderr)
        self.assertEqual(self.command("1", "controller", nearest[1]).returncode, 0)
        self.assertNotEqual(self.command("1", "controller", str(int(nearest[1]) + 1)).returncode, 0)
        places = ", ".join(rf"{place} \(\w+\)" for place in range(int(nearest[1]) + 1))
        self.assertRegex(refused.stderr, rf"; there (is|are) {places}\n$")
        self.assertRegex(self.command("1", "estimator", "77").stderr, r"would be obeyed; there (is|are) 0 \(\w+\)")

    def test_a_refused_scale_shows_the_sensor_reading_and_the_range(self):
        refused = self.command("1", "scale", "1")
        self.assertRegex(refused.stderr, r"^supercoil: 1 scale 1: refused: out_of_range; the sensor shows \S+ m there: "
                         r"(\S+ to \S+ are in range|no scale can turn that into a place)\n$")

    def test_a_refusal_is_explained_after_its_name(self):
        self.command("1", "disarm")
        for words, why in ((("1", "position", "0.01"), "wrong_state: arm it first, or reset its fault; or command the channel that leads its joint or bundle"),
                           (("1", "reset"), "wrong_state: it has no fault"),
                           (("1", "rest"), "wrong_state: it is already resting, or is off")):
            self.assertEqual(self.command(*words).stderr, f"supercoil: {' '.join(words)}: refused: {why}\n")
        # Programs get only its name.
        self.assertEqual(json.loads(self.command("1", "reset", "--json").stdout)["answer"], "refused: wrong_state")

    def test_a_script_reads_and_writes_settings_over_the_bus(self):
        def setting(*words, source=self.source):
            return subprocess.run([SUPERCOIL, "setting", *words, "--can", source], capture_output=True, text=True,
                                  timeout=60)

        known = dict(line.split(" = ") for line in setting("1").stdout.splitlines())
        self.assertEqual((len(known), known["max_power_W"], known["measurement_Hz"]), (15, "4.5", "100"))
        written = setting("1", "measurement_Hz", "50", "--json")
        self.assertEqual((written.returncode, json.loads(written.stdout)),
                         (0, {"setting": "measurement_Hz", "value": 50.0, "refusal": "none"}))
        self.assertEqual(setting("1", "measurement_Hz").stdout, "measurement_Hz = 50\n")
        refused = setting("1", "max_power_W", "5")
        self.assertEqual((refused.returncode, refused.stdout), (1, "max_power_W = 4.5\n"))
        self.assertEqual(refused.stderr, "supercoil: max_power_W: refused: out_of_range; 4.5 would be obeyed; 0 to 4.5 are in range\n")
        outside = "refused: out_of_range: the value is out of range; "
        room = " are in range, up to its ticks a second, as far as its bus has room"
        for name, value, expected in (("status_Hz", "0", f"{outside}1 to 1000{room}"),
                                  ("measurement_Hz", "0.001", f"{outside}0, for never, and 0.01 to 1000{room}"),
                                  ("supply_gain", "1.1", f"{outside}it is read-only: supercoil doctor --compare-senses determines it")):
            self.assertEqual(setting("1", name, value).stderr, f"supercoil: {name}: {expected}\n")
        for written, meant in (("mesurement_Hz", "did you mean measurement_Hz?"), ("max_powr_W", "did you mean max_power_W?"),
                               ("max_power_W=2", "write max_power_W 2"), ("loudness", "there are: max_power_W, measurement_Hz, ")):
            unknown = setting("1", written)
            self.assertEqual(unknown.returncode, 2)
            self.assertIn(f"'{written}' is not a setting; {meant}", unknown.stderr)
        self.assertEqual(setting("1", "bandwidth_rad_per_s", "3").stderr, "supercoil: 'bandwidth_rad_per_s' is tuned: "
                         f"supercoil tune 1 bandwidth_rad_per_s=3 --can {self.source}\n")
        renamed = setting("1", "most_power_W")
        self.assertEqual((renamed.returncode, renamed.stderr),
                         (2, "supercoil: 'most_power_W' was renamed in 0.2.0: write max_power_W\n"))
        self.assertIn("no answer from node 9", setting("9", "status_Hz").stderr)
        self.assertEqual(setting("1", "measurement_Hz", "100").returncode, 0)

    def test_a_refused_setting_without_a_value_prints_none(self):
        self.arm_by_script()
        held = subprocess.Popen([SUPERCOIL, "command", "1", "position", "0.001", "--hold", "--can", self.source])
        self.addCleanup(held.wait, SLACK_S)
        self.addCleanup(held.terminate)
        until(lambda: "node 1: active" in self.command("state").stdout)
        refused = subprocess.run([SUPERCOIL, "setting", "1", "max_power_W", "2", "--can", self.source], capture_output=True, text=True, timeout=SLACK_S)
        self.assertEqual((refused.returncode, refused.stdout, refused.stderr),
                         (1, "", "supercoil: max_power_W: refused: not_lease_holder: another program commands this muscle\n"))


class BrokenMuscle(unittest.TestCase):
    def test_the_fault_that_interrupted_identify_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            scenario = pathlib.Path(folder) / "breaks.toml"
            scenario.write_text((ROOT / "host_sim" / "scenarios" / "bench.toml").read_text()
                                + "\n[[event]]\nat_s = 20\ninjected_fault.heater_open = true\n")
            board = simulated_board(scenario=scenario)
            self.addCleanup(board.stop)
        source = f"socketcand:{board.found[1]}"
        until(lambda: command(source, "1", "arm").returncode == 0)
        done = command(source, "1", "identify", "--for", "60", "--json")
        why = "fault heater_open; see faults/heater_open in `supercoil docs`"
        self.assertEqual((done.returncode, json.loads(done.stdout), done.stderr),
                         (1, {"command": "1 identify", "result": "interrupted", "cause": why},
                          f"supercoil: 1 identify ended: interrupted, {why}\n"))


if __name__ == "__main__":
    unittest.main()
