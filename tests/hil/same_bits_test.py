#!/usr/bin/env python3
"""Simulations on the emulated board and on this machine: the same to the bit, every value of every tick and every frame.

Prints what was compared; exits with 1 if any of it is wrong, 2 if the board did not do its part. This machine's simulator is
that of build/release: tests/hil/prepare --architecture amd64.

    tests/hil/same_bits_test.py [--architecture amd64]
"""

import argparse
import hashlib
import pathlib
import re
import subprocess
import tempfile

import rig
from table import Table

# In fixed point, as in the firmware of a small board; and in double, where nobody guarantees it.
SCENARIOS = ("fixed-point", "sine")
SIMULATOR = rig.ARCHITECTURES["amd64"].programs / "supercoil-sim"


def result_here(scenario):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "run"
        subprocess.run([SIMULATOR, "run", scenario, "--out", out, "--no-plot", "--quiet"], check=True)
        return hashlib.sha256((out / "trace.csv").read_bytes() + (out / "can.log").read_bytes()).hexdigest()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    rig.add_architecture(parser)
    settings = rig.Settings(parser.parse_args().architecture, "same_bits_test", time_out_s=1200.0, free_running=True)
    if not SIMULATOR.exists():
        parser.error(f"{SIMULATOR} is missing: run tests/hil/prepare --architecture amd64")
    table = Table()

    def judge(table, run):
        there = re.findall(r"^result (\w+)", run.console.replace("\r", ""), re.M)[0]
        table.row(f"{scenario}: trace and CAN log are the same to the bit", there == here, 1, 1, "")

    for scenario in SCENARIOS:
        here = result_here(scenario)
        table.judge(scenario, judge, rig.run(rig.HERE / "scripts" / "same_bits", (scenario,), settings))
    table.end()


if __name__ == "__main__":
    main()
