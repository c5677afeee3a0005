"""Joint in can.log of a simulated joint: cantools decodes it, and its values are those of the run."""

import csv
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import cantools

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATABASE = cantools.database.load_file(ROOT / "firmware" / "io" / "can" / "supercoil.dbc")
JOINT = DATABASE.get_message_by_name("Joint")
LINE = re.compile(r"\((\d{10})\.(\d{6})\) can0 ([0-9A-F]{3})#((?:[0-9A-F]{2})*)\n")
EPOCH_S = 1_000_000_000
LEVER_M = 0.015
DURATION_S = 6.0
AMBIENT_C = 25.0
SCENARIO = f"simulation.duration_s = {DURATION_S}\n[joint]\nlever_m = {LEVER_M}\n"
# Signals, and the columns of the trace that they show; the trace has temperatures as a rise.
COLUMNS = {"reference_deg": "reference_m", "effort_W": "power_W", "agonist_coldest_C": "coldest_K", "agonist_hottest_C": "hottest_K",
           "agonist_applied_W": "applied_power_W", "antagonist_coldest_C": "antagonist_coldest_K",
           "antagonist_hottest_C": "antagonist_hottest_K", "antagonist_applied_W": "antagonist_applied_power_W"}
TO_SIGNAL = {"deg": lambda metres: math.degrees(metres / LEVER_M), "W": float, "degC": lambda rise_K: AMBIENT_C + rise_K}


def run(scenario):
    """The trace, and every frame: its tick, identifier and data."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / "s.toml").write_text(scenario)
        subprocess.run([os.environ["SUPERCOIL_SIM"], "run", "s.toml", "--out", "out", "--no-plot", "--quiet"], check=True,
                       cwd=path, capture_output=True)
        with open(path / "out" / "trace.csv") as file:
            trace = list(csv.DictReader(file))
        frames = []
        for line in (path / "out" / "can.log").read_text().splitlines(keepends=True):
            seconds, microseconds, identifier, data = LINE.fullmatch(line).groups()
            tick = (int(seconds) - EPOCH_S) * 1000 + int(microseconds) // 1000
            frames.append((tick, int(identifier, 16), bytes.fromhex(data)))
        return trace, frames


class TwoMuscles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.trace, cls.frames = run(SCENARIO)
        cls.joint_frames = [(tick, JOINT.decode(data)) for tick, identifier, data in cls.frames if identifier == JOINT.frame_id]

    def assert_shows(self, signal, value, tick):
        """The trace's value in this tick or the one before: frames wait for each other."""
        signal = JOINT.get_signal_by_name(signal)
        column = COLUMNS.get(signal.name, "measured_m")
        truths = [TO_SIGNAL[signal.unit](float(self.trace[at][column])) for at in (tick, max(0, tick - 1))]
        nearest = min(abs(value - truth) for truth in truths)
        self.assertLessEqual(nearest, 0.5 * signal.scale + 1e-5 * abs(truths[0]) + 1e-6, f"tick {tick}: {signal.name} = {value}: {truths}")

    def test_only_the_agonists_node_sends_all_parts_in_turn(self):
        self.assertEqual([tick for tick, identifier, _ in self.frames if identifier == JOINT.frame_id + 1], [])
        self.assertAlmostEqual(len(self.joint_frames), 50 * DURATION_S, delta=1)
        parts = [joint["part"].value for _, joint in self.joint_frames]
        self.assertEqual(parts, [(parts[0] + i) % 6 for i in range(len(parts))])

    def test_decoded_values_match_the_trace(self):
        seen = set()
        for tick, joint in self.joint_frames:
            self.assert_shows("angle_deg", joint["angle_deg"], tick)
            for name in joint.keys() & COLUMNS.keys():
                self.assert_shows(name, joint[name], tick)
                seen.add(name)
        self.assertEqual(seen, COLUMNS.keys())

    def test_values_outside_the_trace_match_both_nodes(self):
        newest, seen = {}, set()
        for _, identifier, data in self.frames:
            if identifier == JOINT.frame_id:
                joint = JOINT.decode(data)
                for name, message, node, signal in (("agonist_resistance_Ohm", "Measurement", 1, "resistance_Ohm"),
                                                    ("antagonist_resistance_Ohm", "Measurement", 2, "resistance_Ohm"),
                                                    ("co_contraction_W", "Power", 2, "demanded_W")):
                    of_node = newest.get((message, node))
                    if name in joint and of_node and str(of_node[signal]) != "not_available":
                        self.assertAlmostEqual(joint[name], of_node[signal], delta=0.05)
                        seen.add(name)
            for node in (1, 2):
                for message in ("Measurement", "Power"):
                    layout = DATABASE.get_message_by_name(message)
                    if identifier == layout.frame_id - 1 + node:
                        newest[message, node] = layout.decode(data)
        self.assertEqual(len(seen), 3)

    def test_error_is_the_angle_minus_the_model_angle(self):
        for tick, joint in self.joint_frames:
            if "error_deg" in joint:
                model_deg = [math.degrees(float(self.trace[at]["model_m"]) / LEVER_M) for at in (tick, max(0, tick - 1))]
                self.assertLess(min(abs(joint["angle_deg"] - model - joint["error_deg"]) for model in model_deg), 0.001, tick)


class OneMuscle(unittest.TestCase):
    def test_a_spring_joint_has_four_parts(self):
        _, frames = run(SCENARIO + 'opposed_by = "spring"\n')
        joints = [JOINT.decode(data) for _, identifier, data in frames if identifier == JOINT.frame_id]
        self.assertAlmostEqual(len(joints), 50 * DURATION_S, delta=1)
        parts = [one["part"].value for one in joints]
        self.assertEqual(parts, [(parts[0] + i) % 4 for i in range(len(parts))])
        self.assertEqual({str(one["co_contraction_W"]) for one in joints if "co_contraction_W" in one}, {"not_available"})


if __name__ == "__main__":
    unittest.main()
