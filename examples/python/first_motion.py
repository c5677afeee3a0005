"""First motion: arms a muscle, moves it to 5 mm, holds it there, and lets it rest.

python first_motion.py can0
python first_motion.py socketcand:29536 2.5     # millimetres
"""

import sys

import supercoil


def main(address, target_mm=5.0):
    with supercoil.Muscle(address, node=1) as muscle:
        muscle.arm()
        muscle.move_to(target_mm / 1e3)
        print(f"at {1e3 * muscle.position_m:.2f} mm, {muscle.telemetry.temperature.hottest_C:.0f} °C at most")
        muscle.hold(2.0)
        muscle.rest()
    print("let go")


if __name__ == "__main__":
    main(sys.argv[1], *map(float, sys.argv[2:]))
