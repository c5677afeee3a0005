"""Calibrates a cold muscle, identifies it, prints the results, and plots the recording. Takes a minute or two.

python identify_and_plot.py can0 identification.svg
"""

import sys

import supercoil


def main(address, picture):
    with supercoil.Muscle(address, node=1) as muscle:
        muscle.arm()
        with muscle.record("Measurement", "Tracking", "Power", "Temperature") as recording:
            print("calibrated:", muscle.calibrate().result)
            outcome = muscle.identify()
        print("identified:", outcome.result, *outcome.notes)
        for quantity, value in muscle.quantities().items():
            print(f"{quantity.name:28} {value:.4g}")
    supercoil.plot(recording.table(), picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
