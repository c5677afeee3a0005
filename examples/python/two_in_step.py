"""Two muscles follow one sine, half a period apart: both set points go out in one call.

python two_in_step.py can0,1 can0,2
python two_in_step.py socketcand:29536,1 socketcand:29536,2 10     # seconds, of supercoil-sim ... --nodes 2
"""

import asyncio
import math
import sys

import supercoil

MIDDLE_M, AMPLITUDE_M, PERIOD_S = 0.004, 0.002, 8.0
EVERY_S = 0.02


async def main(first, second, seconds=16.0):
    async with supercoil.Muscle(*place(first)) as one, supercoil.Muscle(*place(second)) as two:
        for muscle in (one, two):
            await muscle.arm()
        start = asyncio.get_running_loop().time()
        while (elapsed := asyncio.get_running_loop().time() - start) < seconds:
            swing_m = AMPLITUDE_M * math.sin(2 * math.pi * elapsed / PERIOD_S)
            told = await supercoil.cycle([one.make_position(MIDDLE_M + swing_m),
                                          two.make_position(MIDDLE_M - swing_m)])
            print(f"{elapsed:6.2f} s " + " ".join(f"{1e3 * message.position_m:7.3f} mm" for message in told))
            await asyncio.sleep(EVERY_S)


def place(text):
    """can0,2 -> the address and the node."""
    address, _, node = text.rpartition(",")
    return address, int(node)


if __name__ == "__main__":
    asyncio.run(main(*sys.argv[1:3], *map(float, sys.argv[3:])))
