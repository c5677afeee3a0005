"""supercoil doctor as seen by a user or a script on a machine that is not a board: exit status, text, JSON.

tests/hil/doctor_test.py runs it on the emulated board, which has devices.
"""

import fcntl
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["SUPERCOIL"]
SLOW = pathlib.Path(os.environ["SUPERCOIL_EXAMPLES"]) / "raspberry-pi-pca9685-ads1115.toml"


class Doctor(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        text = SLOW.read_text()
        # Names that exist on no machine, so that nothing can be touched.
        for old, new in (("pinctrl-bcm2711", "no-such-chip"), ("i2c-1/1-0040", "no-such-pwm/0"),
                         ("/dev/watchdog", "/dev/no-such-watchdog")):
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.storage = self.path / "learned"
        self.storage.mkdir()
        text = text.replace("[board]\n", f'[board]\nstorage_folder = "{self.storage}"\n', 1)
        (self.path / "b.toml").write_text(text)

    def run_doctor(self, *arguments, **options):
        folder = () if "--run-folder" in arguments else ("--run-folder", ".")
        return subprocess.run([PROGRAM, "doctor", "--config", "b.toml", *folder, *arguments],
                              stderr=subprocess.PIPE, text=True, cwd=self.path, timeout=60,
                              **{"stdout": subprocess.PIPE, **options})

    def findings(self, *arguments):
        done = self.run_doctor("--json", *arguments)
        self.assertEqual(done.stderr, "")
        report = json.loads(done.stdout)
        for verdict, key in (("problem", "problems"), ("warning", "warnings")):
            self.assertEqual(sum(f["severity"] == verdict for f in report["findings"]), report[key])
        self.assertEqual(done.returncode, 1 if report["problems"] else 0)
        for finding in report["findings"]:
            self.assertEqual(list(finding), ["what", "severity", "found", "remedy"])
            self.assertEqual(finding["remedy"] == "", finding["severity"] == "ok", finding)
        names = [finding["what"] for finding in report["findings"]]
        self.assertEqual(len(names), len(set(names)))
        return {finding["what"]: finding for finding in report["findings"]}

    def test_every_missing_device_is_named_with_its_path(self):
        found = self.findings()
        for what in ("heartbeat", "stop_circuit", "light", "channel 1, enable", "channel 4, enable"):
            self.assertEqual(found[what]["severity"], "problem")
            self.assertRegex(found[what]["found"], "^no chip with the label 'no-such-chip' in /dev: there ")
            self.assertIn("gpioinfo", found[what]["remedy"])
        for what in ("channel 1, pwm", "channel 4, pwm", "supply", "channel 1, position", "channel 4, current"):
            self.assertEqual(found[what]["severity"], "problem")
            self.assertRegex(found[what]["found"], "(in|list) /sys/")
        self.assertEqual(found["watchdog"]["severity"], "problem")
        self.assertIn("/dev/no-such-watchdog: No such file or directory; in /sys/class/watchdog",
                      found["watchdog"]["found"])
        self.assertIn("by the configuration; not measured", found["bus i2c-1"]["found"])

    def test_checks_without_a_device(self):
        found = self.findings()
        for what in ("kernel", "real-time share", "priority", "other programs", "locked memory", "deep sleep",
                     "frequency", "processors"):
            self.assertIn(found[what]["severity"], ("ok", "warning"))
        self.assertIn(os.uname().release, found["kernel"]["found"])

    def test_as_text_each_finding_has_its_line_and_its_remedy(self):
        done = self.run_doctor()
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertRegex(done.stdout, r"(?m)^problem  channel 2, enable +no chip with the label 'no-such-chip' in /dev")
        lines = done.stdout.splitlines()
        for line, after in zip(lines, lines[1:]):
            if line.startswith(("warning ", "problem ")):
                self.assertRegex(after, "^         what to do: .")
        self.assertRegex(lines[-1], r": \d+ problems, \d+ warnings?, \d+ in order$")

    def test_no_device_is_touched_while_a_daemon_runs(self):
        with open(self.path / "lock", "w") as lock:
            lock.write("4711\n")
            lock.flush()
            fcntl.flock(lock, fcntl.LOCK_EX)
            found = self.findings()
        self.assertEqual(found["devices"]["severity"], "warning")
        self.assertEqual(found["devices"]["found"],
                         "not checked: ./lock: another supercoild drives this board, process 4711")
        self.assertNotIn("heartbeat", found)
        self.assertIn("kernel", found)
        self.assertIn("bus i2c-1", found)

    def test_without_its_folder_no_device_is_touched(self):
        found = self.findings("--run-folder", "none")
        self.assertIn("none/lock: the lock file cannot be created: No such file or directory; create its folder, "
                      "or name another (--run-folder)", found["devices"]["found"])
        self.assertNotIn("heartbeat", found)

    def test_warnings_alone_are_not_a_failure(self):
        text = (self.path / "b.toml").read_text()
        (self.path / "b.toml").write_text("".join(
            line for line in text.splitlines(keepends=True) if not line.startswith("watchdog")))
        found = self.findings("--run-folder", "none")
        self.assertEqual({finding["severity"] for finding in found.values()}, {"ok", "warning"})
        self.assertEqual(found["watchdog"]["found"], "none: board.watchdog is absent")

    def test_the_bus_of_the_configuration_and_its_load(self):
        with open(self.path / "b.toml", "a") as file:
            file.write('[can]\ninterface = "no-can6"\nbit_rate = 500000\n')
        found = self.findings()
        self.assertEqual(found["CAN no-can6"]["severity"], "problem")
        self.assertRegex(found["CAN load"]["found"], r"^\d+\.\d % of 500 kbit/s at worst, without commands; the limit is 50.0 %$")

    def test_what_the_channels_have_learned_can_be_loaded(self):
        def storage():
            found = self.findings()["storage"]
            return found["severity"], found["found"]

        self.assertEqual(storage(), ("ok", f"{self.storage}: learned by channel 1 nothing, channel 2 nothing, "
                                     "channel 3 nothing, channel 4 nothing"))
        (self.storage / "learned-2.toml").write_text("")
        self.assertEqual(storage(), ("problem", f"{self.storage}/learned-2.toml: is empty; "
                                     f"{self.storage}/learned-2.toml.previous: is not there"))
        (self.storage / "learned-2.toml").unlink()
        self.storage.rmdir()
        severity, found = storage()
        self.assertEqual(severity, "problem")
        self.assertIn(f"{self.storage}: cannot be opened as a folder", found)

    def test_a_can_interface_is_checked_only_on_request(self):
        self.assertNotIn("CAN", " ".join(self.findings()))
        found = self.findings("--can", "no-can7")["CAN no-can7"]
        self.assertEqual(found["severity"], "problem")
        self.assertIn("no interface 'no-can7' in /sys/class/net: there ", found["found"])

    def test_a_realtime_kernel_is_named_for_this_architecture(self):
        found = self.findings()["kernel"]
        package = {"x86_64": "linux-image-rt-amd64", "aarch64": "linux-image-rt-arm64"}.get(os.uname().machine)
        if found["severity"] == "ok" or package is None:
            self.skipTest("no advice here")
        self.assertIn(f"on Debian {package}:", found["remedy"])

    @unittest.skipIf(pathlib.Path("/etc/supercoil/board.toml").exists(), "this machine has one")
    def test_without_a_configuration_it_checks_the_machine_and_names_the_examples(self):
        done = subprocess.run([PROGRAM, "doctor", "--json"], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        found = {finding["what"]: finding for finding in json.loads(done.stdout)["findings"]}
        for what in ("kernel", "priority", "processors", "GPIO chips", "PWM chips", "I2C buses", "SPI devices",
                     "CAN interfaces", "converters"):
            self.assertIn(found[what]["severity"], ("ok", "warning"))
        self.assertEqual(found["configuration"]["severity"], "problem")
        self.assertIn("/etc/supercoil/boards", found["configuration"]["remedy"])
        self.assertIn("this machine: 1 problem, ", subprocess.run([PROGRAM, "doctor"], capture_output=True, text=True).stdout)
        for arguments in (("--config", "none.toml"), ("--config", "none.toml", "--json")):
            done = subprocess.run([PROGRAM, "doctor", *arguments], capture_output=True, text=True)
            expected = json.dumps({"error": done.stderr}, separators=(",", ":")) + "\n" if "--json" in arguments else ""
            self.assertEqual((done.returncode, done.stdout), (2, expected))

    def test_a_wrong_configuration(self):
        (self.path / "b.toml").write_text("nonsense")
        done = self.run_doctor()
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("b.toml:1", done.stderr)

    def test_unknown_options(self):
        self.assertEqual(self.run_doctor("--priority", "0").returncode, 2)
        self.assertEqual(self.run_doctor("--heat").returncode, 2)

    def test_a_full_standard_output_is_an_error(self):
        for arguments in ((), ("--json",)):
            with open("/dev/full", "w") as full:
                done = self.run_doctor(*arguments, stdout=full)
            self.assertEqual(done.returncode, 1)
            self.assertIn("cannot write to standard output", done.stderr)


if __name__ == "__main__":
    unittest.main()
