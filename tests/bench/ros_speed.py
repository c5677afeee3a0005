"""How fast supercoil-ros is. It reports, and judges nothing.

States of eight simulated muscles at 200 Hz, as a peer on DDS receives them, while it sends set points for all of them.

    SUPERCOIL_SIM=build/release/bin/supercoil-sim .venv/bin/python tests/bench/ros_speed.py

It finds the package in firmware/python, and uses loopback only.
"""

import os
import pathlib
import subprocess
import sys
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "firmware" / "python"
sys.path[:0] = [str(PACKAGE), str(ROOT / "tests" / "ros")]
from peer import LOOPBACK, Peer

from supercoil import sync

DOMAIN = 230
RATE_HZ = 200
JOINTS = [f"joint_{node}" for node in range(1, 9)]
SECONDS = 20.0


def processor_s(pid):
    times = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(times[11]) + int(times[12])) / os.sysconf("SC_CLK_TCK")


def measure(peer, bridge):
    states = peer.reader("rt/joint_states", "sensor_msgs/msg/JointState")
    commands = peer.writer("rt/supercoil/joint_commands", "sensor_msgs/msg/JointState")
    while not peer.call("/supercoil/arm", 60.0)[0]:
        time.sleep(0.5)
    nothing, sent_s = np.array([]), []
    states.take()
    used_s, begin_s = processor_s(bridge.pid), time.monotonic()
    while (now_s := time.monotonic() - begin_s) < SECONDS:
        positions_m = np.full(len(JOINTS), 0.001 + 0.0005 * np.sin(now_s))
        commands.write(peer.message("sensor_msgs/msg/JointState", peer.header(), JOINTS, positions_m, nothing, nothing))
        sent_s += [state.header.stamp.sec + 1e-9 * state.header.stamp.nanosec for state in states.take()]
        time.sleep(1.0 / RATE_HZ)
    gaps_ms = 1e3 * np.diff(sent_s)
    print(f"states: {len(sent_s) / SECONDS:.1f} a second, {np.percentile(gaps_ms, 50):.2f} ms apart in the median, "
          f"{np.percentile(gaps_ms, 99):.2f} ms in 99 of 100, {gaps_ms.max():.2f} ms at most")
    print(f"processor: {(processor_s(bridge.pid) - used_s) / SECONDS:.2f} of a core")


def main():
    environment = {**os.environ, "CYCLONEDDS_URI": LOOPBACK, "PYTHONPATH": str(PACKAGE)}
    with sync.Simulation("bench", options=("--nodes", str(len(JOINTS))), deadline_s=1e6) as simulation:
        joints = [word for node, name in enumerate(JOINTS, 1) for word in ("--joint", f"{name}={node}")]
        bridge = subprocess.Popen([sys.executable, "-m", "supercoil.ros", simulation.address, *joints, "--rate",
                                   str(RATE_HZ), "--domain", str(DOMAIN)], env=environment)
        try:
            measure(Peer(DOMAIN), bridge)
        finally:
            bridge.terminate()
            bridge.wait()


if __name__ == "__main__":
    main()
