"""Runs on the emulated board, by scripts/python: the package over a CAN controller and by the board's own socket.

Each moves the muscle and plays 2 s of a motion; prints the references that it received meanwhile."""

import math
import sys

import supercoil
from supercoil import sync

REST_M = 0.004
TIMES_S = [0.05 * i for i in range(41)]
POSITIONS_M = [REST_M + 0.00025 * (1.0 - math.cos(math.pi * time_s)) for time_s in TIMES_S]


def use(name, address, node):
    with sync.Muscle(address, node, deadline_s=60.0) as muscle:
        muscle.arm()
        muscle.move_to(REST_M, timeout_s=60.0)
        print(f"{name} moved to {1e3 * muscle.position_m:.3f} mm", flush=True)
        with muscle.record("Tracking") as recording:
            muscle.play(TIMES_S, POSITIONS_M, settle_s=1.0)
        references_m = [tracking.reference_m for tracking in recording.of(supercoil.messages.Tracking)]
        print(f"{name} played up to {1e3 * max(filter(math.isfinite, references_m)):.3f} mm", flush=True)


print(f"python {sys.version.split()[0]}, supercoil {supercoil.__version__}", flush=True)
use("bus", "can1", 1)
use("socket", "/run/supercoil/commands", 1)
