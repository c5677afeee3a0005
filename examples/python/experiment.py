"""An experiment: moves a muscle through a table of set points, and makes a table and a figure of the results.

python experiment.py can0 set_points.csv results.csv figure.svg

set_points.csv:
position_mm,hold_s
2,5
4,5
"""

import csv
import sys

import supercoil


def main(address, set_points, results, figure):
    with open(set_points) as file:
        steps = [(float(row["position_mm"]) / 1e3, float(row["hold_s"])) for row in csv.DictReader(file)]
    rows = []
    with supercoil.Muscle(address, node=1) as muscle:
        muscle.arm()
        with muscle.record("Measurement", "Tracking", "Power", "Temperature") as whole:
            for target_m, hold_s in steps:
                muscle.move_to(target_m)
                with muscle.record("Measurement", "Power") as held:
                    muscle.hold(hold_s)
                errors_m = [message.position_m - target_m for message in held.of(supercoil.messages.Measurement)]
                powers_W = [message.applied_W for message in held.of(supercoil.messages.Power)]
                rows.append({"position_mm": 1e3 * target_m,
                             "error_rms_um": 1e6 * (sum(error**2 for error in errors_m) / len(errors_m)) ** 0.5,
                             "power_W": sum(powers_W) / len(powers_W),
                             "hottest_C": muscle.telemetry.temperature.hottest_C})
                print(rows[-1])
    with open(results, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    supercoil.plot(whole.table(), figure)


if __name__ == "__main__":
    main(*sys.argv[1:])
