"""The examples do on the simulated board what they say."""

import ast
import asyncio
import csv
import json
import pathlib
import runpy
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

from patience import DEADLINE_S, QUICK, STARVED, TRIES, patient

import supercoil
from supercoil import sync

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "python"


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.simulation = sync.Simulation(QUICK, options=("--nodes", "2"), deadline_s=60.0).start()
        cls.addClassCleanup(cls.simulation.stop)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)

    def run_example(self, name, *arguments):
        """What it prints. Begins again when it was starved and its command expired."""
        for _ in range(TRIES):
            done = subprocess.run([sys.executable, EXAMPLES / name, *map(str, arguments)], capture_output=True,
                                  text=True, timeout=DEADLINE_S)
            if not any(error.__name__ in done.stderr for error in STARVED):
                break
            for node in (1, 2):
                with sync.Muscle(self.simulation.address, node) as muscle:  # gives the lease back
                    if muscle.fault != supercoil.Fault.none:
                        muscle.reset()
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_first_motion(self):
        self.assertRegex(self.run_example("first_motion.py", self.simulation.address, 0.5),
                         r"^at 0\.[3-7]\d mm, \d\d °C at most\nlet go\n$")

    def test_two_in_step(self):
        text = self.run_example("two_in_step.py", f"{self.simulation.address},1", f"{self.simulation.address},2", 1)
        self.assertRegex(text, r"^.*,1: off its way by 0\.\d\d mm at most\n.*,2: off its way by 0\.\d\d mm at most\n$")

    def test_experiment_writes_a_table_and_a_figure(self):
        (self.path / "set_points.csv").write_text("position_mm,hold_s\n0.4,0.5\n0.5,0.5\n")
        self.run_example("experiment.py", self.simulation.address, self.path / "set_points.csv",
                         self.path / "results.csv", self.path / "figure.svg")
        with open(self.path / "results.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["position_mm"] for row in rows], ["0.4", "0.5"])
        self.assertTrue(all(0.0 < float(row["error_rms_um"]) < 1000.0 and float(row["power_W"]) > 0 for row in rows))
        self.assertTrue((self.path / "figure.svg").exists())

    @patient
    def test_identify_and_plot(self):
        # Identification itself takes a minute in real time, a calibration ten seconds.
        def learn(muscle):
            muscle.set_power(1.0)
            muscle.hold(0.5)
            return supercoil.Outcome(supercoil.Result.found, ())
        example = runpy.run_path(str(EXAMPLES / "identify_and_plot.py"))
        with mock.patch.object(sync.Muscle, "identify", learn), mock.patch.object(sync.Muscle, "calibrate", learn), \
                mock.patch("builtins.print") as printed:
            example["main"](self.simulation.address, self.path / "picture.svg")
        self.assertIn("stiffness_N_per_m            16", [call.args[0] for call in printed.call_args_list])
        self.assertTrue((self.path / "picture.svg").exists())

    @patient
    def test_the_notebook_runs(self):
        notebook = json.loads((EXAMPLES / "notebook.ipynb").read_text())
        names = {}

        async def run_cells():
            for cell in notebook["cells"]:
                if cell["cell_type"] == "code":
                    self.assertEqual(cell["outputs"], [])
                    # Nearer set points: a reference model takes its time.
                    source = "".join(cell["source"]).replace("0.002, 0.003, 0.002", "0.0004, 0.0005")
                    source = source.replace('"bench"', f'"{QUICK}"')
                    compiled = compile(source, "notebook", "exec", ast.PyCF_ALLOW_TOP_LEVEL_AWAIT)
                    if (waiting := eval(compiled, names)) is not None:
                        await waiting

        async def run_and_end():
            try:
                await run_cells()
            finally:
                if "simulation" in names:
                    await names["simulation"].stop()
        asyncio.run(run_and_end())
        self.assertGreater(names["table"]["Measurement.position_m"].max(), 0.0002)

    def test_the_shell_moves_and_plots(self):
        typed = "muscle.arm()\nmuscle.move_to(0.0004)\nplot(5)\nmuscle.state.name, len(table(2)) > 10\n"
        for _ in range(TRIES):
            done = subprocess.run([sys.executable, "-m", "supercoil", "--simulation", QUICK], input=typed, text=True,
                                  capture_output=True, timeout=DEADLINE_S, cwd=self.path)
            if "('active', True)" in done.stdout:
                break
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("('active', True)", done.stdout)
        self.assertTrue((self.path / "supercoil.png").exists())

    def test_the_shell_reports_errors(self):
        for arguments, said in (([], "an address or --simulation"), (["socketcand:1"], "socketcand on 127.0.0.1:1")):
            done = subprocess.run([sys.executable, "-m", "supercoil", *arguments], capture_output=True, text=True,
                                  timeout=DEADLINE_S)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(said, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
