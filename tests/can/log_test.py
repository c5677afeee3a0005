"""supercoil log of a CAN log: what it writes is what cantools reads, for every value of every frame."""

import csv
import json
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import cantools
import mcap.reader

ROOT = pathlib.Path(__file__).resolve().parents[2]
DBC = ROOT / "firmware" / "io" / "can" / "supercoil.dbc"
LINE = re.compile(r"\((\d+\.\d+)\) can0 ([0-9A-F]{3})#([0-9A-F]*)")
EPOCH_S = 1_000_000_000  # of a simulated run: 2001-09-09 01:46:40 UTC
SCENARIO = "simulation.duration_s = 4.0\n[[event]]\nat_s = 3.0\ninjected_fault.heater_open = true\n"
# Of a float in nine digits.
RELATIVE = 1e-7


def is_available(value):
    named = isinstance(value, cantools.database.namedsignalvalue.NamedSignalValue)
    return str(value) != "not_available" if named else not math.isnan(value)


def same(text, value):
    if isinstance(value, cantools.database.namedsignalvalue.NamedSignalValue):
        return text == str(value)
    return math.isclose(float(text), value, rel_tol=RELATIVE, abs_tol=1e-12)


class Log(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.path = pathlib.Path(folder.name)
        (cls.path / "s.toml").write_text(SCENARIO)
        subprocess.run([os.environ["SUPERCOIL_SIM"], "run", "s.toml", "--out", ".", "--no-trace", "--no-plot",
                        "--allow-fault", "--quiet"], cwd=cls.path, check=True, timeout=300)
        database = cantools.database.load_file(DBC)
        cls.frames = []  # time, message, signals
        for line in (cls.path / "can.log").read_text().splitlines():
            stamp, frame_id, data = LINE.fullmatch(line).groups()
            time_s = round(float(stamp) - EPOCH_S, 6)
            message = database.get_message_by_frame_id(int(frame_id, 16))
            cls.frames.append((time_s, message.name, message.decode(bytes.fromhex(data))))

    def log(self, *arguments):
        return subprocess.run([os.environ["SUPERCOIL"], "log", *map(str, arguments)], cwd=self.path, capture_output=True,
                              text=True, timeout=120)

    def rows(self, *arguments):
        done = self.log(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return list(csv.DictReader(done.stdout.splitlines()))

    def test_times_keep_their_microseconds(self):
        """After a month, too: the board's clock in an Emergency has 48 bits."""
        emergency = cantools.database.load_file(DBC).get_message_by_name("Emergency")
        data = emergency.encode({"fault": 30, "state": 3, "board_time_s": 2592000.123457})
        (self.path / "month.log").write_text(f"(2592000.125000) can0 081#{data.hex().upper()}\n")
        values = {row["signal"]: row["value"] for row in self.rows("month.log")}
        self.assertEqual(values["board_time_s"], "2592000.123457")
        wide, = self.rows("month.log", "--message", "Emergency")
        self.assertEqual((wide["time_s"], wide["board_time_s"]), ("2592000.125000", "2592000.123457"))

    def test_a_log_that_starts_at_0_has_the_same_times(self):
        text = (self.path / "can.log").read_text()
        self.assertEqual(len(re.findall(r"^\(1000000", text, re.M)), len(text.splitlines()))
        (self.path / "old.log").write_text(re.sub(r"^\(1", "(0", text, flags=re.M))
        self.assertTrue(self.log("can.log").stdout == self.log("old.log").stdout)

    def test_values_match_cantools(self):
        rows = iter(self.rows("can.log"))
        count = 0
        for time_s, message, signals in self.frames:
            for name, value in signals.items():
                if not is_available(value):
                    continue
                row = next(rows)
                self.assertEqual((float(row["time_s"]), row["node"], row["message"], row["signal"]), (time_s, "1", message, name))
                self.assertTrue(same(row["value"], value), (row, value))
                count += 1
        self.assertIsNone(next(rows, None))
        self.assertGreater(count, 4000)
        self.assertEqual({message for _, message, _ in self.frames},
                         {"Emergency", "FirstCause", "Measurement", "Tracking", "Power", "Heater", "Temperature", "Estimate", "Margin",
                          "Limit", "Timing", "Gain", "Status", "Boot"})

    def test_each_row_of_one_message_is_a_frame(self):
        for message in ("Tracking", "Estimate", "Emergency"):
            rows = self.rows("can.log", "--message", message, "--node", 1)
            frames = [(time_s, signals) for time_s, name, signals in self.frames if name == message]
            self.assertEqual(len(rows), len(frames))
            for row, (time_s, signals) in zip(rows, frames):
                self.assertEqual((float(row.pop("time_s")), row.pop("node")), (time_s, "1"))
                for name, text in row.items():
                    available = name in signals and is_available(signals[name])
                    self.assertEqual(text != "", available, (name, text))
                    self.assertTrue(not available or same(text, signals[name]))

    def test_mcap_values_match_cantools(self):
        self.assertEqual(self.log("can.log", "--mcap", "--out", "can.mcap").returncode, 0)
        with open(self.path / "can.mcap", "rb") as file:
            messages = list(mcap.reader.NonSeekingReader(file).iter_messages())
        self.assertEqual(len(messages), len(self.frames))
        for (schema, channel, message), (time_s, name, signals) in zip(messages, self.frames):
            self.assertEqual((channel.topic, schema.name), (f"/node_1/{name}", f"supercoil.{name}"))
            self.assertEqual(message.log_time, round(1e6 * time_s) * 1000)
            for signal, value in json.loads(message.data).items():
                available = signal in signals and is_available(signals[signal])
                self.assertEqual(value is not None, available, (name, signal))
                self.assertTrue(not available or same(value, signals[signal]), (name, signal, value))
        done = self.log("can.log", "--mcap", "--message", "Tracking", "--node", 1, "--out", "tracking.mcap")
        self.assertEqual(done.returncode, 0)
        with open(self.path / "tracking.mcap", "rb") as file:
            topics = {channel.topic for _, channel, _ in mcap.reader.NonSeekingReader(file).iter_messages()}
        self.assertEqual(topics, {"/node_1/Tracking"})

    def test_from_and_to_are_inclusive(self):
        first, last = self.frames[100][0], self.frames[300][0]
        within = [row for row in self.rows("can.log") if first <= float(row["time_s"]) <= last]
        self.assertEqual(self.rows("can.log", "--from", first, "--to", last), within)
        self.assertGreater(len(within), 200)

    def test_out_is_written_completely_or_not_at_all(self):
        self.assertEqual(self.log("can.log", "--out", "can.csv").returncode, 0)
        self.assertEqual((self.path / "can.csv").read_text(), self.log("can.log").stdout)
        done = self.log("can.log", "--node", 9, "--out", "none.csv")
        self.assertEqual(done.returncode, 2)
        self.assertFalse((self.path / "none.csv").exists())
        with open("/dev/full", "w") as full:
            done = subprocess.run([os.environ["SUPERCOIL"], "log", "can.log"], cwd=self.path, stdout=full,
                                  stderr=subprocess.PIPE, text=True, timeout=120)
        self.assertEqual(done.returncode, 1)
        self.assertIn("standard output", done.stderr)

    def test_the_log_itself_is_not_replaced(self):
        text = (self.path / "can.log").read_text()
        (self.path / "soft.log").symlink_to("can.log")
        os.link(self.path / "can.log", self.path / "x.csv.part")
        for name, out in (("can.log", "can.log"), ("soft.log", "can.log"), ("can.log", "soft.log"), ("x.csv.part", "x.csv")):
            done = self.log(name, "--out", out)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(f"{out}: would replace {name} itself", done.stderr)
        self.assertEqual((self.path / "x.csv.part").read_text(), text)

    def test_a_pipe_is_refused_instead_of_losing_its_beginning(self):
        with open(self.path / "can.log") as log:
            text = log.read()
        done = subprocess.run([os.environ["SUPERCOIL"], "log", "/dev/stdin"], input=text, capture_output=True, text=True, timeout=120)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("/dev/stdin: is not a file", done.stderr)

    def test_a_damaged_first_line_is_skipped_like_any_other(self):
        text = (self.path / "can.log").read_text()
        rest = text[text.index("\n") + 1:]
        (self.path / "rest.log").write_text(rest)
        rows = self.rows("rest.log")
        for first in (text[8:text.index("\n")], "# recorded on the bench", ""):
            (self.path / "cut.log").write_text(f"{first}\n{rest}")
            done = self.log("cut.log")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(list(csv.DictReader(done.stdout.splitlines())), rows)
            self.assertEqual("1 such line is skipped" in done.stderr, first != "")

    def test_errors_are_reported(self):
        (self.path / "half.log").write_text((self.path / "can.log").read_text()[:1000])
        for arguments, status, why in (
                (("can.log", "--message", "Nonsense"), 2, "--message Nonsense: there are Sync, Emergency, FirstCause, Knot, Play"),
                (("can.log", "--from", "2", "--to", "1"), 2, "--from must not be later"),
                (("can.log", "--summary"), 2, "is a CAN log"),
                (("can.log", "--node", "64"), 2, "--node"),
                (("can.log", "--from", "1e6"), 2, "can.log: has no frame of that node, message and time"),
                (("can.log", "--message", "Knot", "--mcap"), 2, "can.log: has no frame of that node, message and time"),
                (("flight-1.scfr", "--message", "Power"), 2, "is not a CAN log"),
                (("half.log",), 0, "half.log:"), (("none.log",), 2, "there is no such file")):
            done = self.log(*arguments)
            self.assertEqual(done.returncode, status, arguments)
            self.assertIn(why, done.stderr)
            self.assertEqual(done.stdout == "", status == 2, arguments)


if __name__ == "__main__":
    unittest.main()
