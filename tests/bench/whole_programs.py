"""How fast the simulator's programs are as they are started: `run`, its traces, a campaign on one core and on all.

Programs to compare run in turn on the same machine; medians are printed beside the goals.
"""

import json
import os
import pathlib
import statistics
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SUPERCOIL_SIM", ROOT / "build/release/bin/supercoil-sim")
RUNS = 5
DRAWN = 200
CORES = len(os.sched_getaffinity(0))
# 200 s of the paper's muscle at 1 kHz with its MRAC and the gradient estimator.
STUDY = f"""
[study]
runs = {DRAWN}
scenario = "sine"
[scenario.simulation]
duration_s = 200.0
[goals]
tracking_rms_m = 1e-3
[[draw]]
keys = ["plant.stiffness_N_per_m"]
uniform = [14.0, 18.0]
"""


def run_s(*arguments):
    """How long a program takes."""
    begins_s = time.monotonic()
    subprocess.run([PROGRAM, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)
    return time.monotonic() - begins_s


def row(what, value, unit, goal):
    print(f"{what:<58}{value:10.4g} {unit:<14}{goal}")


def runs(folder):
    factors, csv_s, npy_s, none_s = [], [], [], []
    usual = ("run", "sine", "--quiet", "--no-plot", "--no-can", "--out", folder / "run")
    for _ in range(RUNS):
        none_s.append(run_s(*usual, "--no-trace"))
        factors.append(json.loads((folder / "run" / "summary.json").read_text())["realtime_factor"])
        csv_s.append(run_s(*usual))
        npy_s.append(run_s(*usual, "--npy"))
    row("run sine, nothing but its summary", statistics.median(factors), "x real time", "goal: 3000 or more")
    row("    trace.csv", statistics.median(csv_s) - statistics.median(none_s), "s", "goal: 0.1 or less")
    row("    trace.npy in its place", statistics.median(npy_s) - statistics.median(none_s), "s", "goal: 0.1 or less")


def campaigns(folder):
    study = folder / "speed.toml"
    study.write_text(STUDY)
    per_second = {1: [], CORES: []}
    for attempt in range(RUNS):
        for jobs, rates in per_second.items():
            took_s = run_s("campaign", study, "--jobs", jobs, "--quiet", "--no-plot", "--out", folder / f"{jobs}-{attempt}")
            rates.append(DRAWN / took_s)
    one, all_of_them = (statistics.median(rates) for rates in per_second.values())
    row("campaign, runs of 200 s, one core", one, "runs/s", "")
    row(f"    {CORES} cores", all_of_them, "runs/s", "goal, of two cores: 35 or more")
    row(f"    {CORES} cores beside one", all_of_them / one, "", "goal, of two cores: 1.9 or more")


def main():
    with tempfile.TemporaryDirectory() as name:
        runs(pathlib.Path(name))
        if CORES > 1:
            campaigns(pathlib.Path(name))


if __name__ == "__main__":
    main()
