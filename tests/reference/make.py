"""Writes the reference values that the unit tests compare with: one JSON file per topic.

Everything here is computed with numpy and scipy from the equations in docs, never from the
library under test. Seeds are fixed: two runs write the same files.
"""

import argparse
import json
import pathlib

import actuator
import estimation
import joint
import linear
import mrac
import muscle_effects
import plant
import tracking

TOPICS = {
    "actuator": actuator.cases,
    "linear": linear.cases,
    "estimation": estimation.cases,
    "mrac": mrac.cases,
    "tracking": tracking.cases,
    "plant": plant.cases,
    "muscle_effects": muscle_effects.cases,
    "joint": joint.cases,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for the files")
    parser.add_argument("--only", choices=TOPICS, help="one topic instead of all")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for topic in [arguments.only] if arguments.only else TOPICS:
        text = json.dumps(TOPICS[topic](), indent=None, allow_nan=False)
        (arguments.out / f"{topic}.json").write_text(text + "\n")


if __name__ == "__main__":
    main()
