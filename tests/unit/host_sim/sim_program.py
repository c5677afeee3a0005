"""supercoil-sim in its own folder, for tests."""

import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["SUPERCOIL_SIM"]
EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "firmware/io/config/examples"
SHORT = "simulation.duration_s = 2.0\n"


class ProgramCase(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)

    def run_program(self, *arguments, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.path, timeout=300, **options)

    def scenario(self, text):
        (self.path / "s.toml").write_text(text)
        return "s.toml"
