"""The paper's MRAC for 200 s on the physical muscle: supercoil-sim beside scipy's solve_ivp.

Alternating runs on the same machine; prints each one's speed and the median ratio. The two also
have to agree on the tracking error, or the ratio would compare different things.
"""

import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SUPERCOIL_SIM", ROOT / "build/release/bin/supercoil-sim")
SCENARIO = """
[simulation]
duration_s = 200.0
[sensor.position]
noise_rms_m = 0.0
resolution_bits = 0
[controller]
kind = "mrac"
preset = "printed"
adaptation_scale = 10.0
freeze_when_limited = false
[estimator]
kind = "none"
"""
RUNS = 5


def ours(folder):
    (folder / "mrac.toml").write_text(SCENARIO)
    subprocess.run([PROGRAM, "run", folder / "mrac.toml", "--no-trace", "--no-plot", "--quiet",
                    "--window", "160:200", "--out", folder / "out"], check=True)
    summary = json.loads((folder / "out/summary.json").read_text())
    return summary["realtime_factor"], summary["tracking_rms_m"] * 1e6


def scipy():
    done = subprocess.run([sys.executable, ROOT / "tests/reference/mrac_ode.py", "--design",
                           "printed", "--factor", "10", "--duration", "200"],
                          check=True, capture_output=True, text=True)
    factor, error = re.search(r"realtime_factor=(\S+) late_rms_um=(\S+)", done.stdout).groups()
    return float(factor), float(error)


def main():
    ratios = []
    with tempfile.TemporaryDirectory() as name:
        for _ in range(RUNS):
            (fast, our_error), (slow, scipy_error) = ours(pathlib.Path(name)), scipy()
            ratios.append(fast / slow)
            print(f"supercoil-sim {fast:8.0f} x real time, {our_error:6.2f} um;  "
                  f"solve_ivp {slow:6.1f} x, {scipy_error:6.2f} um;  ratio {ratios[-1]:6.0f}")
            if abs(our_error - scipy_error) > 0.1 * scipy_error:
                sys.exit("the two do not agree: the ratio means nothing")
    print(f"median ratio: {statistics.median(ratios):.0f}")


if __name__ == "__main__":
    main()
