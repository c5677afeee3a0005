"""supercoil-ros on the command line: what it refuses, and how."""

import pathlib
import subprocess
import sys
import unittest
from xml.etree import ElementTree

from supercoil.ros.names import resolved
from supercoil.ros.options import Options

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "ros"


def run(*words, code="from supercoil.ros.cli import main; raise SystemExit(main())"):
    return subprocess.run([sys.executable, "-c", code, *words], capture_output=True, text=True, timeout=60)


class Command(unittest.TestCase):
    def test_invalid_arguments_are_reported_with_the_allowed_values(self):
        for words, expected in (
                (["can0"], "the following arguments are required: --joint"),
                (["can0", "--joint", "finger"], "finger: must be NAME=NODE, with a node of 1 to 63, as finger=1"),
                (["can0", "--joint", "finger=64"], "finger=64: must be NAME=NODE"),
                (["can0", "--joint", "fin-ger=1"], "joint 'fin-ger': must be letters, digits and _"),
                (["can0", "--joint", "a=1", "--joint", "a=2"], "--joint: name a is given twice"),
                (["can0", "--joint", "a=1", "--joint", "b=1"], "--joint: node 1 is given twice"),
                (["can0", "--joint", "a=1", "--rate", "0"], "0: must be 1 to 1000 Hz"),
                (["can0", "--joint", "a=1", "--command-timeout", "nan"], "nan: must be 0.05 to 3600 s"),
                (["can0", "--joint", "a=1", "--domain", "233"], "233: must be 0 to 232"),
                (["can0", "--joint", "a=1", "--states", "a//b"], "topic 'a//b': must be names of letters")):
            with self.subTest(words):
                done = run(*words)
                self.assertIn(done.returncode, (1, 2))
                self.assertIn(expected, done.stderr)
                self.assertNotIn("Traceback", done.stderr)

    def test_without_cyclone_it_names_what_to_install(self):
        code = ("import sys; from importlib import util; util.find_spec = lambda name: None; "
                "from supercoil.ros.cli import main; raise SystemExit(main())")
        done = run("can0", "--joint", "a=1", code=code)
        self.assertEqual((done.returncode, done.stderr),
                         (1, 'supercoil-ros: needs Eclipse Cyclone DDS: pip install "supercoil[ros]"\n'))

    def test_arguments_of_ros_launch_files_are_ignored(self):
        self.assertEqual(run("can0", "--version", "--ros-args", "-r", "__node:=x").returncode, 0)

    def test_the_ros2_control_example_matches_the_bridge(self):
        system = ElementTree.parse(EXAMPLES / "finger.urdf").getroot().find("ros2_control")
        parameters = {param.get("name"): param.text for param in system.iter("param")}
        launch = (EXAMPLES / "finger.launch.py").read_text()
        compile(launch, "finger.launch.py", "exec")
        self.assertEqual(parameters["joint_commands_topic"], resolved(Options.commands, Options.node))
        self.assertIn(f'"--states", "{parameters["joint_states_topic"]}"', launch)
        joint = system.find("joint").get("name")
        self.assertIn(f'"{joint}="', launch)
        self.assertIn(f"joints: [{joint}]", (EXAMPLES / "controllers.yaml").read_text())


if __name__ == "__main__":
    unittest.main()
