"""Moves two muscles to and fro, half a period apart. The boards receive the motion in advance and start together.

python two_in_step.py can0,1 can0,2
python two_in_step.py socketcand:29536,1 socketcand:29536,2 1     # periods, of supercoil-sim ... --nodes 2
"""

import asyncio
import math
import sys

import supercoil

MIDDLE_M, AMPLITUDE_M, PERIOD_S = 0.004, 0.002, 8.0
EVERY_S = 0.05


async def main(first, second, periods=2):
    times_s = [i * EVERY_S for i in range(round(periods * PERIOD_S / EVERY_S) + 1)]
    swings_m = [AMPLITUDE_M * math.cos(2 * math.pi * time_s / PERIOD_S) for time_s in times_s]
    async with supercoil.Muscle(*place(first)) as one, supercoil.Muscle(*place(second)) as two:
        for muscle in (one, two):
            await muscle.arm()
        motions = [one.make_motion(times_s, [MIDDLE_M - swing_m for swing_m in swings_m]),
                   two.make_motion(times_s, [MIDDLE_M + swing_m for swing_m in swings_m])]
        await asyncio.gather(*(muscle.move_to(knots[0].position_m) for muscle, knots in motions))
        with one.record("Tracking") as of_one, two.record("Tracking") as of_two:
            await supercoil.play(motions, settle_s=0.5)
    for at, recording in ((first, of_one), (second, of_two)):
        errors_m = [told.error_m for told in recording.of(supercoil.messages.Tracking)]
        worst_m = max(abs(error_m) for error_m in errors_m if math.isfinite(error_m))
        print(f"{at}: off its way by {1e3 * worst_m:.2f} mm at most")


def place(text):
    """Splits can0,2 into address and node."""
    address, _, node = text.rpartition(",")
    return address, int(node)


if __name__ == "__main__":
    asyncio.run(main(*sys.argv[1:3], *map(int, sys.argv[3:])))
