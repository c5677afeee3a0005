"""supercoild as seen by a user or a script: exit status and messages."""

import fcntl
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
import zlib

PROGRAM = os.environ["SUPERCOILD"]
EXAMPLES = pathlib.Path(os.environ["SUPERCOIL_EXAMPLES"])
SLOW = EXAMPLES / "raspberry-pi-pca9685-ads1115.toml"


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)

    def run_program(self, *arguments, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], text=True, cwd=self.path, timeout=60,
                              **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options})

    def changed(self, old, new):
        text = SLOW.read_text()
        self.assertIn(old, text)
        (self.path / "b.toml").write_text(text.replace(old, new, 1))
        return "b.toml", text[:text.index(old)].count("\n") + 1

    def test_examples_are_valid(self):
        examples = sorted(EXAMPLES.glob("*.toml"))
        self.assertEqual(len(examples), 4)
        for example in examples:
            with self.subTest(example.name):
                done = self.run_program("--check", example)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn("\nbus time per tick of", done.stdout)
                self.assertIn("\nmemory, excluding program and stacks\n", done.stdout)
                self.assertIn("\ndetectors that cannot work", done.stdout)

    def test_check_prints_bus_time_and_memory(self):
        done = self.run_program("--check", SLOW)
        self.assertIn("  i2c-1: 1.988 ms, 19.9 %, at 400 kHz\n", done.stdout)
        self.assertRegex(done.stdout, r"\n  total    \d+ KiB\n")

    def test_check_prints_every_key_with_its_value_default_and_range(self):
        done = self.run_program("--check", SLOW, "--keys")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"^key +value +default +line +allowed\n")
        self.assertRegex(done.stdout, r"\nboard\.rate_Hz +100 +1000 +\d+ +100 to 10000\n")
        listed = json.loads(self.run_program("--check", SLOW, "--keys", "--json").stdout)["keys"]
        keys = {each["key"]: each for each in listed}
        self.assertEqual(len(keys), done.stdout.count("\n") - 1)
        self.assertEqual(keys["board.late_ms"], {"key": "board.late_ms", "type": "number", "value": 5.0, "default": 5.0,
                                                 "required": False, "line": 0, "min": 0.001, "max": 10.0})
        self.assertEqual(keys["channel[4].limits.preset"]["names"], ["nylon", "skin"])

    def test_keys_of_a_wrong_file_are_its_problems(self):
        name, line = self.changed("rate_Hz = 100", "rate_Hz = 1")
        done = self.run_program("--check", name, "--keys")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn(f"{name}:{line}: ", done.stderr)
        alone = self.run_program("--keys")
        self.assertEqual((alone.returncode, alone.stdout), (2, ""))
        self.assertIn("--keys requires --check", alone.stderr)

    def test_check_prints_json_for_programs(self):
        done = self.run_program("--check", EXAMPLES / "raspberry-pi-pwm-ads1115.toml", "--json")
        report = json.loads(done.stdout)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(report["board"], "two muscles")
        self.assertEqual((report["can"]["interface"], report["can"]["bit_rate"]), ("can0", 500000))
        self.assertEqual([channel["learned_version"] for channel in report["channels"]], [0, 0])
        self.assertRegex(report["advice"][0], "^channels 1, 2: in the coldest air it rests ")
        can = report["channels"][0]["feasibility"]
        text = self.run_program("--check", EXAMPLES / "raspberry-pi-pwm-ads1115.toml").stdout
        self.assertIn(f"  can do      holds {1e3 * can['travel_m']:.3g} mm indefinitely, at {can['held_W']:.3g} W", text)
        self.assertIn(f"controller 0: margin {can['controllers'][0]['margin']:.2g}, holds if no parameter is off by more than", text)
        self.assertIn(f"and holds up to {1e3 * can['cold_travel_m']:.3g} mm above its zero there", text)
        self.assertIn(f"\n  recommended controller = {{ kind = \"{can['recommended']['kind']}\", shape_reference = true, ", text)

    def test_check_prints_every_mistake_as_json(self):
        file, line = self.changed("rate_Hz", "rate_kHz")
        done = self.run_program("--check", file, "--json")
        self.assertEqual((done.returncode, done.stderr), (2, ""))
        problems = json.loads(done.stdout)["problems"]
        self.assertIn((file, line, "board.rate_kHz"), [(p["file"], p["line"], p["key"]) for p in problems])

    def test_json_goes_with_check_or_latency_only(self):
        done = self.run_program("--json")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--json requires --check or --latency", done.stderr)

    def learned(self, channel, version, **tables):
        body = f"version = {version}\n" + "".join(
            f"\n[{name}]\n" + "".join(f"{key} = {value}\n" for key, value in table.items()) for name, table in tables.items())
        (self.path / f"learned-{channel}.toml").write_text(
            f"# supercoil learned, format 2, {len(body)} bytes, CRC-32 {zlib.crc32(body.encode()):08x}\n{body}")

    def test_check_uses_the_learned_values(self):
        muscle = {"thermal_mass_J_per_K": 0.17, "heat_transfer_W_per_K": 0.09, "stiffness_N_per_m": 16.5, "damping_Ns_per_m": 2.0,
                  "moving_mass_kg": 0.09, "force_per_kelvin_N_per_K": 0.0086}
        calibration = {"position_offset_m": 0.0, "position_scale": 1.0, "cold_resistance_Ohm": 10.0}
        senses = {"supply_gain": 1.01, "current_gain": 0.99, "error_ratio": 0.02, "compared_s": 1795219200.0}
        self.learned(1, 3, muscle=muscle, calibration=calibration, senses=senses, small_motions={"response_ratio": 0.01})
        name, _ = self.changed("rate_Hz = 100.0", f'rate_Hz = 100.0\nstorage_folder = "{self.path}"')
        done = self.run_program("--check", name)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(f"channel 1: with what was learned before, version 3 in {self.path}\n", done.stdout)
        self.assertIn("senses      compared with a meter on 2026-11-", done.stdout)
        self.assertIn("1 % arrive at the sensor, as identify measured: friction takes the rest; up to ", done.stdout)
        self.assertRegex(done.stdout, "channel 1: heater_not_responding: friction leaves too little of a small motion")
        self.assertEqual(done.stdout.count("until they are compared with a meter"), 3)

    def test_check_prints_the_locked_memory(self):
        # Four channels at 1 kHz without buses: the recorder takes most of the memory.
        text = re.sub(r'^bus = .*\n|, bus = "[^"]*"', "", SLOW.read_text(), flags=re.M)
        text = re.sub(r"\[\[bus\]\]\nname = .*\nclock_Hz = .*\n", "", text).replace("rate_Hz = 100.0", "rate_Hz = 1000.0")
        (self.path / "b.toml").write_text(text)
        done = self.run_program("--check", "b.toml")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        locked = re.search(r"\n  locked   ([\d.e+]+) MiB: this and its relay, the program with its libraries ([\d.e+]+) MiB, "
                           r"2 stacks 0.3 MiB\n$", done.stdout)
        self.assertIsNotNone(locked, done.stdout[-500:])
        recorder_MiB = 4 * 1000 * (16 + 2) * 112 / 2**20
        if float(locked[2]) < 1000.0:  # a sanitizer maps terabytes
            self.assertGreater(float(locked[1]), recorder_MiB + float(locked[2]))
            self.assertLessEqual(float(locked[1]), 16.5)

    def test_off_names_devices_that_it_cannot_reach(self):
        done = self.run_program("--off", *self.no_such_board())
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("b.toml: channel 4, enable: no chip with the label 'no-such-chip'", done.stderr)
        self.assertTrue(done.stderr.endswith("supercoild: problem: everything else is off\n"), done.stderr)

    def test_off_while_a_daemon_runs(self):
        with open(self.path / "lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            done = self.run_program("--off", *self.no_such_board())
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, "another supercoild drives this board")

    def test_a_misspelt_key(self):
        file, line = self.changed("off_A = 0.01", "of_A = 0.01")
        done = self.run_program("--check", file)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr,
                         f"b.toml:{line}: every_channel.current.of_A = 0.01: is not a key of "
                         "[every_channel.current]; did you mean off_A?\n")

    def test_one_converter_for_everything_is_too_slow(self):
        file, line = self.changed('[every_channel.position]      #',
                                  '[every_channel.position]\nwait_ms = 2.6 #')
        done = self.run_program("--check", file)
        self.assertEqual(done.returncode, 2)
        self.assertIn("bus[2].name = 'i2c-3': the bus would be busy for 10.95 ms of a tick of 10 ms "
                      "(110 %); the limit is 70 %", done.stderr)

    def test_a_missing_file(self):
        done = self.run_program("--check", "none.toml")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr, "none.toml: there is no such file\n")

    def test_without_arguments_it_drives_the_board_of_etc(self):
        if pathlib.Path("/etc/supercoil/board.toml").exists():
            self.skipTest("this machine is a board")
        done = self.run_program()
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (2, "", "/etc/supercoil/board.toml: there is no such file\n"))

    def no_such_board(self):
        """Names of devices that exist on no machine, so that nothing can be touched."""
        text = SLOW.read_text()
        for old, new in (("pinctrl-bcm2711", "no-such-chip"), ("i2c-1/1-0040", "no-such-pwm/0"),
                         ('[board]\n', f'[board]\nstorage_folder = "{self.path}"\n')):
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.path / "b.toml").write_text(text)
        return "--config", "b.toml", "--run-folder", "."

    def test_every_missing_device_is_named(self):
        done = self.run_program(*self.no_such_board())
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        for what in ("heartbeat", "stop_circuit", "light", "channel 1, enable", "channel 4, enable"):
            self.assertIn(f"supercoild: problem: b.toml: {what}: no chip with the label 'no-such-chip' in /dev: there",
                          done.stderr)
        self.assertIn("b.toml: channel 3, pwm: ", done.stderr)
        self.assertTrue(done.stderr.endswith("supercoild: problem: nothing was started\n"), done.stderr)

    def test_a_start_logs_the_version(self):
        version = self.run_program("--version").stdout
        self.assertTrue(self.run_program(*self.no_such_board()).stderr.startswith(f"supercoild: version {version}"))

    def test_an_unread_log_does_not_kill_it_by_a_signal(self):
        reader, log = os.pipe()
        os.close(reader)
        self.addCleanup(os.close, log)
        self.assertEqual(self.run_program(*self.no_such_board(), stderr=log).returncode, 1)

    def test_a_missing_folder(self):
        arguments = self.no_such_board()
        done = self.run_program(*arguments[:3], "none")
        self.assertEqual((done.returncode, done.stderr),
                         (1, "supercoild: problem: none/lock: the lock file cannot be created: "
                             "No such file or directory; create its folder, or name another (--run-folder)\n"))

    def test_damaged_learned_values_prevent_a_start(self):
        arguments = self.no_such_board()
        (self.path / "learned-2.toml").write_text("nonsense")
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, 1)
        self.assertIn("learned-2.toml", done.stderr)
        self.assertNotIn("no-such-chip", done.stderr)

    def test_only_one_process_drives_a_board(self):
        arguments = self.no_such_board()
        with open(self.path / "lock", "w") as lock:
            lock.write("4711\n")
            lock.flush()
            fcntl.flock(lock, fcntl.LOCK_EX)
            done = self.run_program(*arguments)
        self.assertEqual((done.returncode, done.stderr),
                         (1, "supercoild: problem: ./lock: another supercoild drives this board, process 4711\n"))

    def test_unknown_options(self):
        self.assertEqual(self.run_program("--chek", SLOW).returncode, 2)
        self.assertEqual(self.run_program("--check").returncode, 2)

    def test_a_full_standard_output_is_an_error(self):
        with open("/dev/full", "w") as full:
            done = self.run_program("--check", SLOW, stdout=full)
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot write to standard output", done.stderr)

    def test_help_and_version(self):
        self.assertIn("--check", self.run_program("--help").stdout)
        self.assertRegex(self.run_program("--version").stdout, r"^\d+\.\d+\.\d+")


if __name__ == "__main__":
    unittest.main()
