"""supercoil log as seen by an operator or a script: exit status, messages, files."""

import collections
import csv
import io
import json
import os
import pathlib
import pty
import re
import resource
import struct
import subprocess
import tempfile
import unittest

import mcap.reader

PROGRAM = os.environ["SUPERCOIL"]
WRITE_SAMPLE = os.environ["WRITE_SAMPLE"]
RECORDING_OF_0_1_0 = pathlib.Path(__file__).resolve().parents[3] / "fuzz/corpus/fuzz_recording/whole"
HEADER, ROW = 512, 112
COLUMNS = ("time_s,channel,state,mode,fault,limited_by,controller,probing,trusted,limited,reference,model_m,"
           "position_m,demanded_W,applied_W,duty,supply_V,current_A,resistance_Ohm,resistance_age_s,coldest_C,"
           "hottest_C,theta1,theta2,theta3,theta4,error_bound,progress,margin_selector,margin_used,margin_measured,"
           "margin_limit,gain_selector,gain,result,multiplexed_selector,multiplexed_value,identify_notes,"
           "proof_off,oscillated,slack").split(",")


class Log(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([WRITE_SAMPLE, folder], check=True, capture_output=True)
            cls.recording = (pathlib.Path(folder) / "flight-1.scfr").read_bytes()

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)
        (self.path / "r.scfr").write_bytes(self.recording)

    def log(self, *arguments, **options):
        return subprocess.run([PROGRAM, "log", *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.path, timeout=60, **options)

    def rows(self, *arguments):
        done = self.log("r.scfr", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return list(csv.DictReader(io.StringIO(done.stdout)))

    def names(self):
        return sorted(p.name for p in self.path.iterdir())

    def test_every_row_is_printed_with_its_columns(self):
        rows = self.rows()
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual(len(rows), 2 * (1101 - 50))
        self.assertEqual((rows[0]["time_s"], rows[-1]["time_s"]), ("-10", "1"))
        self.assertEqual([r["channel"] for r in rows[:4]], ["1", "2", "1", "2"])
        fault = next(r for r in rows if r["fault"] != "none")
        self.assertEqual((fault["time_s"], fault["channel"], fault["fault"], fault["state"], fault["mode"]),
                         ("0", "2", "over_temperature", "fault", "rest"))
        self.assertEqual(fault["resistance_Ohm"], "")
        self.assertEqual(rows[0]["mode"], "position")
        self.assertEqual(float(fault["hottest_C"]), 160.0)

    def test_a_recording_of_0_1_0_is_read(self):
        rows = list(csv.DictReader(io.StringIO(self.log(RECORDING_OF_0_1_0).stdout)))
        self.assertEqual([row["time_s"] for row in rows], ["-0.001", "0"])
        last = {name: rows[-1][name] for name in ("state", "fault", "demanded_W", "applied_W", "margin_selector", "margin_used",
                                                  "gain_selector", "gain", "multiplexed_selector", "multiplexed_value")}
        self.assertEqual(last, {"state": "fault", "fault": "heater_not_responding", "demanded_W": "", "applied_W": "0.01",
                                "margin_selector": "9", "margin_used": "", "gain_selector": "reference", "gain": "",
                                "multiplexed_selector": "35", "multiplexed_value": "4"})

    def test_times_and_channel_can_be_selected(self):
        rows = self.rows("--from", "-0.5", "--to", "0.25", "--channel", "2")
        self.assertEqual({r["channel"] for r in rows}, {"2"})
        self.assertEqual([float(r["time_s"]) for r in rows], [round(i / 100, 2) for i in range(-50, 26)])

    def test_a_gap_shows_in_the_times(self):
        times = [float(r["time_s"]) for r in self.rows("--channel", 1)]
        self.assertEqual([(a, b) for a, b in zip(times, times[1:]) if b - a > 0.011], [(-4.51, -4.0)])

    def test_output_to_a_file_is_the_same(self):
        printed = self.log("r.scfr").stdout
        done = self.log("r.scfr", "--out", "r.csv")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual((self.path / "r.csv").read_text(), printed)
        (self.path / "r.csv.part").write_text("of a run that was killed")
        self.assertEqual(self.log("r.scfr", "--out", "r.csv").returncode, 0)
        self.assertEqual(self.names(), ["r.csv", "r.scfr"])

    def test_mcap_has_the_same_values(self):
        self.assertEqual(self.log("r.scfr", "--mcap", "--out", "r.mcap").returncode, 0)
        piped = subprocess.run([PROGRAM, "log", "r.scfr", "--mcap"], capture_output=True, check=True, cwd=self.path)
        self.assertEqual((self.path / "r.mcap").read_bytes(), piped.stdout)
        rows, faults = [], []
        with open(self.path / "r.mcap", "rb") as file:
            reader = mcap.reader.NonSeekingReader(file)
            for schema, channel, message in reader.iter_messages():
                value = json.loads(message.data)
                self.assertEqual((channel.message_encoding, schema.encoding), ("json", "jsonschema"))
                self.assertEqual(list(json.loads(schema.data)["properties"]), list(value))
                if channel.topic == "/faults":
                    faults.append((message.log_time, value))
                else:
                    rows.append((message.log_time, channel.topic, message.sequence, value))
        with open(self.path / "r.mcap", "rb") as file:
            recording, = mcap.reader.NonSeekingReader(file).iter_metadata()
        self.assertEqual(recording.name, "recording")
        fault_time_ns = int(recording.metadata["fault_time_ns"])
        self.assertEqual({name: recording.metadata[name] for name in ("fault", "fault_number", "fault_channel", "channels")},
                         {"fault": "over_temperature", "fault_number": "30", "fault_channel": "2", "channels": "2"})
        self.assertEqual(faults, [(fault_time_ns, {"channel": 2, "fault": "over_temperature"}),
                                  (fault_time_ns + 500_000_000, {"channel": 1, "fault": "emergency_stop"})])
        printed = self.rows()
        self.assertEqual(len(rows), len(printed))
        for (time_ns, topic, _, value), row in zip(rows, printed):
            self.assertEqual(topic, f"/channel_{row.pop('channel')}")
            self.assertEqual(time_ns, fault_time_ns + round(1e9 * float(row["time_s"])))
            self.assertEqual(list(value), list(row))
            for name, text in row.items():
                same = value[name] == text if isinstance(value[name], str) else value[name] == (float(text) if text else None)
                self.assertTrue(same, (name, value[name], text))
        self.assertEqual([sequence for _, topic, sequence, _ in rows if topic == "/channel_1"], list(range(len(rows) // 2)))

    def test_mcap_has_a_summary(self):
        """PlotJuggler 3 does not open files without a summary."""
        self.assertEqual(self.log("r.scfr", "--mcap", "--out", "r.mcap").returncode, 0)
        with open(self.path / "r.mcap", "rb") as file:
            messages = list(mcap.reader.NonSeekingReader(file).iter_messages())
        with open(self.path / "r.mcap", "rb") as file:
            reader = mcap.reader.make_reader(file)
            self.assertIsInstance(reader, mcap.reader.SeekingReader)
            summary = reader.get_summary()
            self.assertIsNotNone(summary)
            topics = collections.Counter(channel.topic for _, channel, _ in messages)
            counts = summary.statistics.channel_message_counts
            self.assertEqual({channel.topic: counts[number] for number, channel in summary.channels.items()}, topics)
            self.assertEqual({channel.schema_id for channel in summary.channels.values()}, set(summary.schemas))
            statistics = summary.statistics
            self.assertEqual((statistics.message_count, statistics.channel_count, statistics.schema_count, statistics.metadata_count),
                             (len(messages), len(topics), len(topics), 1))
            self.assertEqual((statistics.message_start_time, statistics.message_end_time),
                             (messages[0][2].log_time, messages[-1][2].log_time))
            self.assertEqual([metadata.name for metadata in reader.iter_metadata()], ["recording"])
            self.assertEqual([message for _, _, message in reader.iter_messages(log_time_order=False)],
                             [message for _, _, message in messages])

    def test_mcap_has_units(self):
        self.assertEqual(self.log("r.scfr", "--mcap", "--out", "r.mcap").returncode, 0)
        with open(self.path / "r.mcap", "rb") as file:
            schemas = {channel.topic: json.loads(schema.data)["properties"]
                       for schema, channel, _ in mcap.reader.NonSeekingReader(file).iter_messages()}
        for topic in ("/channel_1", "/channel_2"):
            descriptions = {name: quantity["description"] for name, quantity in schemas[topic].items() if "description" in quantity}
            self.assertEqual(descriptions, {
                "time_s": "in s, relative to the fault", "reference": "in m; in mode power in W", "model_m": "in m",
                "position_m": "in m", "demanded_W": "in W", "applied_W": "in W", "supply_V": "in V", "current_A": "in A",
                "resistance_Ohm": "in Ohm", "resistance_age_s": "in s", "coldest_C": "in degC", "hottest_C": "in degC",
                "theta1": "in m", "theta2": "in W s2/m", "theta3": "in W s/m", "theta4": "in W/m"})

    def test_mcap_of_a_part(self):
        self.assertEqual(self.log("r.scfr", "--mcap", "--channel", 2, "--from", 0, "--to", "0.1", "--out", "r.mcap").returncode, 0)
        with open(self.path / "r.mcap", "rb") as file:
            times = [json.loads(message.data)["time_s"] for _, channel, message in
                     mcap.reader.NonSeekingReader(file).iter_messages(topics=["/channel_2"])]
        self.assertEqual(times, [round(i / 100, 2) for i in range(11)])
        self.refused("r.scfr: has no rows for that channel and time", "r.scfr", "--mcap", "--from", 5, "--out", "out.csv")

    def test_mcap_is_not_written_to_a_terminal(self):
        main, terminal = pty.openpty()
        self.addCleanup(os.close, main)
        with os.fdopen(terminal, "w") as out:
            done = subprocess.run([PROGRAM, "log", "r.scfr", "--mcap"], cwd=self.path, stdout=out, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--mcap: MCAP is not written to a terminal; use --out FILE or a pipe", done.stderr)

    def test_the_summary_says_what_happened(self):
        done = self.log("r.scfr", "--summary")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for text in [
                "over_temperature (fault 30) on channel 2\n",
                "meaning: the estimated temperature passed its limit\n",
                "when: 20.000000 s after the board's clock began",
                "recorded: -10.000 s to 1.000 s, 2102 rows\n",
                "2 channels at 100 Hz\n",
                "ticks are missing: 1 gap, the longest 0.510 s, from -4.510 s on\n",
                "+0.500 s: channel 1: emergency_stop\n",
                "just before: active, position, limited by nothing; position 0.001999 m, reference 0.011 m\n",
                "supply 12 V",
                "just before: no proof of response\n",
                "power: 4 W on average before the fault, 4 W at most\n",
                "hottest: at most 165.0 C, at 1.000 s\n"]:
            self.assertIn(text, done.stdout)
        margins = done.stdout.split("largest first:\n")[1].splitlines()
        self.assertEqual([line.split()[0] for line in margins],
                         ["over_temperature", "under_voltage", "over_travel"])
        self.assertIn("99 % used: 159 of 160 C, at -0.020 s", margins[0])

    def test_the_summary_rounds_what_a_converter_leaves_to_zero(self):
        rows = bytearray(self.recording[HEADER:])
        current_A = 44  # in a row
        for at in range(current_A, len(rows), ROW):
            rows[at:at + 4] = struct.pack("<f", -4.441e-16)
        (self.path / "d.scfr").write_bytes(self.recording[:HEADER] + rows)
        self.assertIn("supply 12 V, current 0 A, resistance", self.log("d.scfr", "--damaged", "--summary").stdout)

    def test_the_summary_has_a_json_form(self):
        done = self.log("r.scfr", "--summary", "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        summary = json.loads(done.stdout)
        self.assertEqual((summary["schema_version"], summary["damage"]), (1, None))
        self.assertEqual(summary["fault"], {"name": "over_temperature", "number": 30, "channel": 2,
                                            "meaning": "the estimated temperature passed its limit", "clock_s": 20.0})
        self.assertEqual((summary["from_s"], summary["to_s"], summary["row_count"], summary["rate_Hz"]), (-10.0, 1.0, 2102, 100.0))
        self.assertAlmostEqual(summary["gaps"].pop("max_s"), 0.51)
        self.assertEqual(summary["gaps"], {"count": 1, "max_from_s": -4.51})
        self.assertEqual(summary["other_faults"], [{"at_s": 0.5, "channel": 1, "name": "emergency_stop"}])
        self.assertEqual([channel["channel"] for channel in summary["channels"]], [1, 2])
        faulty = summary["channels"][1]
        self.assertEqual(faulty["just_before"], {
            "state": "active", "mode": "position", "limited_by": "nothing", "position_m": 0.001999, "reference_m": 0.011,
            "supply_V": 12.0, "current_A": 0.0, "resistance_Ohm": 10.0, "resistance_age_s": 0.0,
            "proof_off": True, "oscillated": False, "slack": False})
        self.assertEqual([faulty[key] for key in ("mean_W", "max_W", "hottest_C", "hottest_at_s")], [4.0, 4.0, 165.0, 1.0])
        self.assertEqual([margin["detector"] for margin in faulty["margins"]],
                         ["over_temperature", "under_voltage", "over_travel"])
        self.assertEqual(faulty["margins"][0], {"detector": "over_temperature", "used_ratio": 0.99375, "measured": 159.0,
                                                "limit": 160.0, "at_s": -0.02})

    def test_errors_have_a_json_form(self):
        for message, arguments in (("none.scfr: there is no such file", ("none.scfr", "--summary", "--json")),
                                   ("--json requires --summary", ("r.scfr", "--json"))):
            done = self.log(*arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, json.loads(done.stdout)["error"])
            self.assertIn(message, done.stderr)

    def refused(self, message, *arguments):
        done = self.log(*arguments)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertIn(message, done.stderr)
        self.assertFalse((self.path / "out.csv").exists(), "something was written")

    def test_damaged_files_are_refused_with_the_reason(self):
        whole = self.recording
        for content, message in [
                (b"", "d.scfr: is empty"),
                (b"time_s,channel\n", "d.scfr: is neither a flight recording nor a log of candump -L"),
                (b"\0" * 9999, "d.scfr: is neither a flight recording nor a log of candump -L"),
                (whole[:20], "d.scfr: is cut off in its first line"),
                (whole[:200], "d.scfr: is cut off in its header: 200 of 512 bytes are there"),
                (whole[:-1], "d.scfr: is cut off: 2101 of 2102 rows are there"),
                (whole + b"x", "d.scfr: has 1 bytes more than were written"),
                (whole[:99] + b"\0" + whole[100:], "d.scfr: is damaged: its header is not as it was written"),
                (whole[:999] + b"\x55" + whole[1000:], "d.scfr: is damaged: its rows have the CRC-32"),
                (whole.replace(b"format 1", b"format 7", 1), "d.scfr: is of format 7; this program reads")]:
            with self.subTest(message):
                (self.path / "d.scfr").write_bytes(content)
                self.refused(message, "d.scfr", "--out", "out.csv")

    def test_a_fault_from_before_the_recording_has_no_time(self):
        rows = bytearray(self.recording[HEADER:])
        for at in range(0, len(rows), ROW):
            if rows[at + 8] == 0:
                rows[at + 11] = 11  # channel 1 was in fault all the time
        (self.path / "d.scfr").write_bytes(self.recording[:HEADER] + rows)
        text = self.log("d.scfr", "--damaged", "--summary").stdout
        self.assertIn("over_temperature (fault 30) on channel 2\n", text)
        self.assertIn("  channel 1: already in fault at the start: sensor_stale\n", text)
        self.assertEqual(json.loads(self.log("d.scfr", "--damaged", "--summary", "--json").stdout)["other_faults"],
                         [{"at_s": None, "channel": 1, "name": "sensor_stale"}])
        self.assertEqual(self.log("d.scfr", "--damaged", "--mcap", "--from", "-1", "--out", "d.mcap").returncode, 0)
        with open(self.path / "d.mcap", "rb") as file:
            faults = [json.loads(message.data) for _, _, message in
                      mcap.reader.NonSeekingReader(file).iter_messages(topics=["/faults"])]
        self.assertEqual(faults, [{"channel": 2, "fault": "over_temperature"}])

    def test_with_damaged_the_readable_rows_are_read(self):
        for content, count, message in [
                (self.recording[:HEADER + 10 * ROW + 5], 10, "is cut off: 10 of 2102 rows are there; 10 rows"),
                (self.recording[:99] + b"\0" + self.recording[100:], 2102, "its header is not as it was"),
                (self.recording[:-5] + b"12345", 2102, "its rows have the CRC-32")]:
            with self.subTest(message):
                (self.path / "d.scfr").write_bytes(content)
                done = self.log("d.scfr", "--damaged")
                self.assertEqual(done.returncode, 0)
                self.assertIn(message, done.stderr)
                self.assertEqual(len(done.stdout.splitlines()), count + 1)
                self.assertEqual(self.log("d.scfr", "--damaged", "--summary").returncode, 0)
        (self.path / "d.scfr").write_bytes(self.recording[:HEADER + 7])
        self.refused("d.scfr: has no whole row", "d.scfr", "--damaged")
        (self.path / "d.scfr").write_bytes(b"something else")
        self.refused("d.scfr: is neither a flight recording nor a log of candump -L", "d.scfr", "--damaged")

    def test_a_summary_says_that_a_cut_recording_ends_before_its_fault(self):
        warning = "  the fault is not in it: all below is from "
        (self.path / "d.scfr").write_bytes(self.recording[:HEADER + 10 * ROW])
        text = self.log("d.scfr", "--damaged", "--summary").stdout
        end_s = re.search(r"recorded: \S+ s to -(\S+) s, 10 rows\n", text)[1]
        self.assertIn(f"{warning}{end_s} s before the fault and earlier\n", text)
        self.assertNotIn(warning, self.log("r.scfr", "--summary").stdout)

    def test_wrong_input_ends_with_status_2(self):
        self.refused("none.scfr: there is no such file", "none.scfr")
        self.refused(".: is not a file", ".")
        self.refused("/dev/null: is not a file", "/dev/null")
        self.refused("the recording has channels 1 to 2", "r.scfr", "--channel", 3)
        self.refused("--channel", "r.scfr", "--channel", 0)
        self.refused("--from must not be later than --to", "r.scfr", "--from", 1, "--to", 0)
        self.refused("--from: nan: must be a finite number", "r.scfr", "--from", "nan")
        self.refused("--from", "r.scfr", "--from", "soon")
        self.refused("has no rows for that channel and time", "r.scfr", "--from", 5)
        self.refused("excludes", "r.scfr", "--summary", "--out", "out.csv")
        self.refused("FILE is required")
        self.assertEqual(subprocess.run([PROGRAM], capture_output=True).returncode, 2)
        self.assertEqual(subprocess.run([PROGRAM, "fly"], capture_output=True).returncode, 2)

    def test_the_recording_itself_and_non_files_are_not_overwritten(self):
        os.link(self.path / "r.scfr", self.path / "again.scfr")
        for name in ["r.scfr", "./r.scfr", "again.scfr"]:
            self.refused(f"{name}: would replace r.scfr itself", "r.scfr", "--out", name)
        self.assertEqual((self.path / "r.scfr").read_bytes(), self.recording)
        os.link(self.path / "r.scfr", self.path / "y.csv.part")
        self.refused("y.csv: would replace y.csv.part itself", "y.csv.part", "--out", "y.csv")
        self.assertEqual((self.path / "y.csv.part").read_bytes(), self.recording)
        (self.path / "folder").mkdir()
        self.refused("folder: is not a file", "r.scfr", "--out", "folder")
        self.refused("/dev/full: is not a file", "r.scfr", "--out", "/dev/full")
        self.refused("none/x.csv.part: cannot be created", "r.scfr", "--out", "none/x.csv")

    def test_a_full_disk_ends_with_status_1_and_keeps_the_old_file(self):
        (self.path / "out.csv").write_text("earlier")

        def small_disk():
            resource.setrlimit(resource.RLIMIT_FSIZE, (50000, 50000))
        done = self.log("r.scfr", "--out", "out.csv", preexec_fn=small_disk, restore_signals=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("out.csv.part: cannot be written", done.stderr)
        self.assertEqual((self.path / "out.csv").read_text(), "earlier")
        self.assertEqual(self.names(), ["out.csv", "r.scfr"])

    def test_a_standard_output_that_cannot_be_written_ends_with_status_1(self):
        for option in [[], ["--summary"]]:
            with open("/dev/full", "w") as full:
                done = subprocess.run([PROGRAM, "log", "r.scfr", *option], cwd=self.path, stdout=full,
                                      stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("standard output: cannot be written: No space left on device", done.stderr)

    def test_a_closed_pipe_ends_with_status_1(self):
        running = subprocess.Popen([PROGRAM, "log", "r.scfr"], cwd=self.path, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        running.stdout.read(10)
        running.stdout.close()
        errors = running.stderr.read().decode()
        running.stderr.close()
        self.assertEqual(running.wait(), 1)
        self.assertIn("standard output: cannot be written: Broken pipe", errors)

    def test_a_misspelt_command_suggests_the_nearest_one(self):
        for written, meant in (("comand", "did you mean command?"), ("xyzzy", "the commands are: log, command, ")):
            done = subprocess.run([PROGRAM, written, "state"], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(f"supercoil: '{written}' is not a command; {meant}", done.stderr)

    def test_help_and_version(self):
        self.assertIn("log", subprocess.run([PROGRAM, "--help"], capture_output=True, text=True).stdout)
        done = self.log("--help")
        self.assertEqual(done.returncode, 0)
        for option in ["--out", "--from", "--to", "--channel", "--damaged", "--summary"]:
            self.assertIn(option, done.stdout)
        self.assertRegex(subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout,
                         r"^\d+\.\d+\.\d+")


if __name__ == "__main__":
    unittest.main()
