"""can.log of a simulated run: cantools decodes every frame, and its values are those that the firmware had in that tick, to
half a quantum: every signal of every message that the flight recording or the trace has."""

import csv
import json
import math
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest

import cantools
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
DBC = ROOT / "firmware" / "io" / "can" / "supercoil.dbc"
LINE = re.compile(r"\((\d{10})\.(\d{6})\) can0 ([0-9A-F]{3})#((?:[0-9A-F]{2}){0,8})\n")
TICK_S = 1e-3
EPOCH_S = 1_000_000_000  # at which a simulated run begins: 2001-09-09 01:46:40 UTC
# Moves, estimates otherwise, is limited, and breaks: the flight recording has every tick of the 10 s before.
SCENARIO = """\
simulation.duration_s = 13.5
[[event]]
at_s = 5.0
estimator.kind = "least_squares"
[[event]]
at_s = 7.0
power.max_W = 1.0
[[event]]
at_s = 12.0
injected_fault.heater_open = true
"""
# Only least squares reports these, one per tick in turn: a value is at most this many ticks old when it is sent.
MULTIPLEXED = {"bias_W": "bias", "theta1_deviation": "theta1_deviation", "theta2_deviation": "theta2_deviation",
          "theta3_deviation": "theta3_deviation", "theta4_deviation": "theta4_deviation", "bias_deviation_W": "bias_deviation"}
MOST_TICKS = 13
# Signals by message, and the recording's columns that they show.
COLUMNS = {
    "Measurement": {"position_m": "position_m", "resistance_Ohm": "resistance_Ohm",
                    "resistance_age_s": "resistance_age_s"},
    "Tracking": {"reference_m": "reference", "model_m": "model_m"},
    "Power": {"demanded_W": "demanded_W", "applied_W": "applied_W", "limited_by": "limited_by", "limited": "limited"},
    "Heater": {"supply_V": "supply_V", "current_A": "current_A", "duty": "duty"},
    "Temperature": {"coldest_C": "coldest_C", "hottest_C": "hottest_C"},
    "Estimate": {"trusted": "trusted", "identify_notes": "identify_notes", "error_bound": "error_bound", "theta1": "theta1", "theta2": "theta2",
                 "theta3": "theta3", "theta4": "theta4"},
    "Margin": {"fault": "margin_selector", "used": "margin_used", "measured": "margin_measured"},
    "Limit": {"fault": "margin_selector", "limit": "margin_limit"},
    "FirstCause": {"measured": "margin_measured", "limit": "margin_limit"},
    "Gain": {"gain": "gain_selector", "value": "gain"},
    "Status": {"state": "state", "mode": "mode", "fault": "fault", "limited_by": "limited_by", "probing": "probing",
               "trusted": "trusted", "limited": "limited", "controller": "controller", "progress": "progress",
               "result": "result"},
}
# Not in the recording's row of the same tick: tested by what they mean.
OTHERWISE = {"Tracking": {"error_m"},
             "Estimate": {*MULTIPLEXED, "parameter", "thermal_mass_J_per_K", "heat_transfer_W_per_K", "stiffness_N_per_m",
                          "damping_Ns_per_m"},
             "Timing": {"late_s", "execution_s", "overruns", "dropped_frames"},
             "Status": {"leased", "counter", "protocol_version", "proof_off", "oscillated", "friction", "slack"},
             "Boot": {"version_major", "version_minor", "version_patch", "commit"},
             "Emergency": {"fault", "state", "board_time_s"}}
MUSCLE = ("thermal_mass_J_per_K", "heat_transfer_W_per_K", "stiffness_N_per_m", "damping_Ns_per_m")
OF_A_JOINT = {"Joint"}  # joint_run_test.py
FROM_MASTER = {"Command", "Acknowledge", "RefusedValue", "Setting", "SettingWrite", "SettingRead", "Muscle",
               "MuscleRead", "Tuning", "TuningWrite", "TuningRead", "Sync", "Knot", "Play", "Trajectory"}  # and its answers


def single(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def muscle_of(theta):
    """The paper's equations: theta = [psi, m eta + mu psi, psi rho + mu eta, eta rho] / gamma."""
    mass, gamma = 0.09, 0.0086
    roots = numpy.roots([theta[0] * mass, *theta[1:]])
    real = [root.real for root in roots if abs(root.imag) < 1e-9]
    psi = theta[0] * gamma
    eta = -max(real) * psi
    rho = theta[3] * gamma / eta
    mu = (theta[1] * gamma - mass * eta) / psi
    found = dict(zip(MUSCLE, (psi, eta, rho, mu)))
    is_muscle = max(root.real for root in roots) < 0 and min(found.values()) > 0
    return found if is_muscle else dict.fromkeys(MUSCLE, math.nan)


class Run(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.path = pathlib.Path(cls.folder.name)
        (cls.path / "s.toml").write_text(SCENARIO)
        subprocess.run([os.environ["SUPERCOIL_SIM"], "run", "s.toml", "--out", "out", "--no-plot", "--allow-fault",
                        "--quiet"], check=True, cwd=cls.path, capture_output=True)
        cls.database = cantools.database.load_file(DBC)
        cls.out = cls.path / "out"
        fault, = json.loads((cls.out / "summary.json").read_text())["faults"]
        cls.fault_tick = round(fault["at_s"] / TICK_S)
        text = subprocess.run([os.environ["SUPERCOIL"], "log", cls.out / "flight-1.scfr"], check=True,
                              capture_output=True, text=True).stdout
        cls.recorded = {cls.fault_tick + round(float(row["time_s"]) / TICK_S): row
                        for row in csv.DictReader(text.splitlines())}
        with open(cls.out / "trace.csv") as file:
            cls.trace = list(csv.DictReader(file))
        cls.frames = list(cls.read_log())

    @classmethod
    def read_log(cls):
        """Ticks, messages, values and raw values of all frames."""
        for line in (cls.out / "can.log").read_text().splitlines(keepends=True):
            seconds, microseconds, identifier, data = LINE.fullmatch(line).groups()
            message = cls.database.get_message_by_frame_id(int(identifier, 16))
            data = bytes.fromhex(data)
            if len(data) != message.length:
                raise AssertionError(f"{message.name}: {len(data)} bytes")
            # A frame is on the wire for 0.3 ms at most, and one channel sends at most three in a tick.
            tick = (int(seconds) - EPOCH_S) * 1000 + int(microseconds) // 1000
            yield tick, message.name, message.decode(data), message.decode(data, scaling=False, decode_choices=False)

    def assert_shows(self, message, name, value, truth, where):
        """truth: as the CSV has it."""
        signal = self.database.get_message_by_name(message).get_signal_by_name(name)
        where = f"{where}: {message}.{name}"
        if str(value) == "not_available" or (signal.is_float and math.isnan(value)):
            self.assertIn(truth, ("", "nan"), where)
        elif signal.choices and not signal.is_float and "not_available" not in map(str, signal.choices.values()):
            self.assertEqual(str(value), truth, where)
        elif signal.is_float:
            self.assertEqual(value, single(float(truth)), where)
        else:
            nearest = min(max(float(truth), signal.minimum), signal.maximum)
            self.assertLessEqual(abs(value - nearest), 0.5 * signal.scale * (1 + 1e-6) + 1e-7 * abs(nearest), where)

    def test_every_signal_is_checked(self):
        for message in self.database.messages:
            if message.name not in FROM_MASTER | OF_A_JOINT:
                seen = COLUMNS.get(message.name, {}).keys() | OTHERWISE.get(message.name, set())
                self.assertEqual(seen, {signal.name for signal in message.signals}, message.name)

    def test_every_message_is_sent_at_its_rate(self):
        for message in self.database.messages:
            count = sum(name == message.name for _, name, _, _ in self.frames)
            if message.cycle_time and message.name not in OF_A_JOINT:
                self.assertAlmostEqual(count, 13500 / message.cycle_time, delta=1, msg=message.name)
        self.assertEqual(sum(name in FROM_MASTER | OF_A_JOINT for _, name, _, _ in self.frames), 0)

    def test_decoded_values_match_the_recording(self):
        looked_at = set()
        for tick, message, values, _ in self.frames:
            row = self.recorded.get(tick)
            if row is None or message not in COLUMNS:
                continue
            for name in COLUMNS[message].keys() & values.keys():
                truth = row[COLUMNS[message][name]]
                if message == "Tracking" and row["mode"] != "position":
                    truth = ""
                self.assert_shows(message, name, values[name], truth, f"tick {tick}")
                looked_at.add((message, name))
        self.assertEqual(looked_at, {(message, name) for message in COLUMNS for name in COLUMNS[message]})

    def test_decoded_values_match_the_trace(self):
        columns = {"reference_m": "reference_m", "model_m": "model_m", "position_m": "measured_m",
                   "demanded_W": "power_W", "applied_W": "applied_power_W", "state": "state", "fault": "fault",
                   "limited_by": "limited_by", "theta1": "theta1", "theta4": "theta4"}
        seen = 0
        for tick, message, values, _ in self.frames:
            if message not in ("Measurement", "Tracking", "Power", "Status", "Estimate"):
                continue
            for name in columns.keys() & values.keys():
                self.assert_shows(message, name, values[name], self.trace[tick][columns[name]], f"tick {tick}")
                seen += 1
        self.assertGreater(seen, 4000)

    def test_margins_and_limits_cycle_through_all_detectors(self):
        for message in ("Margin", "Limit"):
            faults = self.database.get_message_by_name(message).get_signal_by_name("fault").choices
            seen = {raw["fault"] for _, name, _, raw in self.frames if name == message}
            self.assertEqual(seen, faults.keys() - {0}, message)

    def test_error_is_position_minus_model(self):
        for tick, message, values, _ in self.frames:
            row = self.recorded.get(tick)
            if message == "Tracking" and row is not None and row["mode"] == "position":
                truth = single(float(row["position_m"])) - single(float(row["model_m"]))
                self.assertLessEqual(abs(values["error_m"] - truth), 0.5e-6 * (1 + 1e-6), tick)

    def test_estimate_cycles_through_its_parameters(self):
        order = []
        for tick, message, _, raw in self.frames:
            if message == "Estimate":
                has_deviations = {self.trace[tick - ago]["bias_deviation_W"] != "" for ago in (0, MOST_TICKS)}
                order.append((has_deviations, raw["parameter"]))
        for (_, before), (has_deviations, after) in zip(order, order[1:]):
            self.assertIn(after, [(before + 1) % (14 if complete else 8) for complete in has_deviations])
        for has_deviations, count in ((False, 8), (True, 14)):
            self.assertEqual({parameter for ticks, parameter in order if ticks == {has_deviations}}, set(range(count)))

    def test_multiplexed_values_are_the_newest(self):
        recorded, traced = set(), set()
        for tick, message, values, _ in self.frames:
            for name in values.keys() & MULTIPLEXED.keys() if message == "Estimate" else ():
                ticks = range(tick, tick - MOST_TICKS, -1)
                truth = next((t for t in ticks if self.recorded.get(t, {}).get("multiplexed_selector") == MULTIPLEXED[name]), None)
                if truth is not None:
                    self.assert_shows("Estimate", name, values[name], self.recorded[truth]["multiplexed_value"], f"tick {tick}")
                    self.assert_shows("Estimate", name, values[name], self.trace[truth][name], f"tick {tick}")
                    recorded.add(name)
                self.assertIn(values[name], [single(float(self.trace[t][name])) for t in ticks], f"tick {tick}: {name}")
                traced.add(name)
        self.assertEqual(recorded, MULTIPLEXED.keys())
        self.assertEqual(traced, MULTIPLEXED.keys())

    def test_muscle_parameters_follow_from_theta(self):
        seen = set()
        for tick, message, values, _ in self.frames:
            if message != "Estimate":
                continue
            truth = muscle_of([float(self.trace[tick][f"theta{i}"]) for i in range(1, 5)])
            for name in values.keys() & truth.keys():
                if math.isnan(truth[name]):
                    self.assertTrue(math.isnan(values[name]), f"tick {tick}: {name} = {values[name]}")
                else:
                    self.assertAlmostEqual(values[name] / truth[name], 1.0, 3, f"tick {tick}: {name}")
                seen.add((name, math.isnan(values[name])))
        self.assertEqual(len(seen), 8)  # each, as a number and as NaN

    def test_a_fault_sends_an_emergency_at_once(self):
        (tick, _, values, _), = [frame for frame in self.frames if frame[1] == "Emergency"]
        self.assertEqual(tick, self.fault_tick)
        self.assertEqual((str(values["fault"]), str(values["state"])), ("heater_open", "fault"))
        # The board's clock began with its boot, 15 s before the scenario.
        self.assertAlmostEqual(values["board_time_s"], 15.0 + self.fault_tick * TICK_S, delta=2 * TICK_S)

    def test_boot_sends_the_program_version_once_per_second(self):
        version = subprocess.run([os.environ["SUPERCOIL_SIM"], "--version"], check=True, capture_output=True, text=True).stdout.strip()
        numbers, _, commit = version.partition("+")
        boots = [(tick, raw) for tick, message, _, raw in self.frames if message == "Boot"]
        self.assertLessEqual({after - before for (before, _), (after, _) in zip(boots, boots[1:])}, {999, 1000, 1001})
        self.assertGreaterEqual(len(boots), 12)
        for _, raw in boots:
            self.assertEqual(".".join(str(raw[f"version_{part}"]) for part in ("major", "minor", "patch")), numbers)
            self.assertEqual(f"{raw['commit']:07x}", commit.rsplit(".", 1)[-1][:7] if commit else "0000000")

    def test_heartbeat_counts_and_no_tick_is_late(self):
        counters = [raw["counter"] for _, message, _, raw in self.frames if message == "Status"]
        self.assertEqual(counters, [(counters[0] + i) % 256 for i in range(len(counters))])
        for _, message, values, raw in self.frames:
            if message == "Status":
                self.assertEqual((raw["leased"], raw["protocol_version"]), (0, 5))
            elif message == "Timing":
                self.assertEqual((values["late_s"], values["execution_s"]), (0, 0))
                self.assertEqual((raw["overruns"], raw["dropped_frames"]), (0, 0))


if __name__ == "__main__":
    unittest.main()
