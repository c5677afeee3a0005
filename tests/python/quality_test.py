"""The package's types and style, that its synchronous half has all of the asynchronous one, and its wheel."""

import inspect
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile

import supercoil
from supercoil import sync

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "firmware" / "python"


def run(*command, folder=PACKAGE):
    return subprocess.run([sys.executable, "-m", *map(str, command)], cwd=folder, capture_output=True, text=True)


def public(kind):
    return {name: member for name, member in inspect.getmembers(kind) if not name.startswith("_")}


def parameters(function):
    return [str(parameter) for parameter in inspect.signature(function).parameters.values()]


class Quality(unittest.TestCase):
    cache = pathlib.Path(os.environ["PYTHON_CACHE"])

    def test_types_pass_mypy(self):
        done = run("mypy", "--cache-dir", self.cache / "mypy")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_style_passes_ruff(self):
        for folder, options in ((PACKAGE, ()), (ROOT / "tests" / "python", ("--ignore", "ANN")),
                                (ROOT / "tests" / "ros", ("--ignore", "ANN,E402")),
                                (ROOT / "examples" / "python", ("--ignore", "ANN", "--exclude", "move_muscle.py"))):
            done = run("ruff", "check", "--config", PACKAGE / "pyproject.toml", "--cache-dir", self.cache / "ruff",
                       *options, folder)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_synchronous_and_asynchronous_interfaces_match(self):
        for asynchronous, synchronous in ((supercoil.Muscle, sync.Muscle), (supercoil.Simulation, sync.Simulation)):
            theirs, ours = public(asynchronous), public(synchronous)
            ours.pop("of")
            # Attributes of the asynchronous one are properties here.
            self.assertEqual(ours.keys() - {"node", "deadline_s", "address", "scenario"}, theirs.keys())
            for name, member in theirs.items():
                if inspect.isfunction(member):
                    self.assertEqual(parameters(member), parameters(ours[name]), name)

    def test_wheel_is_pure_typed_and_of_the_projects_version(self):
        project, = re.findall(r"project\(supercoil VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
        self.assertEqual(supercoil.__version__, project)
        with tempfile.TemporaryDirectory() as folder:
            done = run("build", "--no-isolation", "--outdir", folder)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            wheel = pathlib.Path(folder) / f"supercoil-{project}-py3-none-any.whl"
            with zipfile.ZipFile(wheel) as opened:
                held = set(opened.namelist())
                metadata = opened.read(f"supercoil-{project}.dist-info/METADATA").decode()
        sources = {str(file.relative_to(PACKAGE)) for file in (PACKAGE / "supercoil").rglob("*.py")}
        self.assertLessEqual(sources | {"supercoil/py.typed"}, held)
        self.assertRegex(metadata, r"Requires-Python: >=3\.11\n")
        self.assertEqual(re.findall(r"^Requires-Dist: ([^;\n]+)$", metadata, re.M), ["python-can>=4.1"])

    def test_import_does_not_load_numpy_pandas_or_matplotlib(self):
        done = subprocess.run([sys.executable, "-c", "import supercoil, sys; "
                               "sys.exit(bool({'numpy', 'pandas', 'matplotlib', 'cantools'} & set(sys.modules)))"])
        self.assertEqual(done.returncode, 0)


if __name__ == "__main__":
    unittest.main()
