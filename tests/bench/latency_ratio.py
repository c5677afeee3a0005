"""How late supercoild's loop wakes, beside cyclictest: the ratio of their p99.99; the goal is at most 1.1.

Both run at 1 kHz and the same priority of SCHED_FIFO, in alternating slices, so that whatever else this machine does
affects both alike. Needs the right to real-time priorities (root), cyclictest (Debian: rt-tests), and for a meaningful
result a machine that does nothing else.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SUPERCOILD", ROOT / "build/release/bin/supercoild")
RATE_HZ = 1000
LONGEST_US = 100_000
GOAL = 1.1
SHARES = {"p50": 0.5, "p99": 0.99, "p99.9": 0.999, "p99.99": 0.9999}
LATE_US = (100, 200, 500, 1000, 10_000)


def supercoild(ticks, options):
    done = subprocess.run([PROGRAM, "--latency", "--json", "--ticks", str(ticks), "--rate", str(RATE_HZ),
                           "--priority", str(options.priority),
                           *(["--cpu", str(options.cpu)] if options.cpu is not None else [])],
                          check=True, capture_output=True, text=True)
    report = json.loads(done.stdout)
    failed = [step["step"] for step in report["set_up"] if not step["worked"]]
    if failed:
        sys.exit(f"supercoild's real-time set-up failed ({', '.join(failed)}): nothing to compare\n{done.stderr}")
    return collections.Counter({int(start): count for start, count in report["late"]["histogram"]})


def cyclictest(ticks, options):
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        subprocess.run(["cyclictest", "-m", "-p", str(options.priority), "-i", str(1_000_000 // RATE_HZ),
                        "-l", str(ticks), "-h", str(LONGEST_US), "-q", f"--json={file.name}",
                        *(["-a", str(options.cpu)] if options.cpu is not None else [])],
                       check=True, stdout=subprocess.DEVNULL)
        thread = json.load(file)["thread"]["0"]
    counts = collections.Counter({int(start): count for start, count in thread["histogram"].items()})
    # Wake-ups beyond the histogram are in none of its bins; adding drops the count when there are none.
    return counts + collections.Counter({LONGEST_US - 1: thread["cycles"] - counts.total()})


def quantile_us(counts, share):
    """The end of the bin that this share of the counts reaches, for both sides alike."""
    wanted = share * counts.total()
    for start in sorted(counts):
        wanted -= counts[start]
        if wanted <= 0:
            return start + 1
    return LONGEST_US


def ratio(pairs):
    ours, theirs = (sum(side, collections.Counter()) for side in zip(*pairs))
    return quantile_us(ours, 0.9999) / quantile_us(theirs, 0.9999)


def uncertainty(pairs, times=200):
    """The interval that holds 90 % of the ratios when the pairs of slices are resampled."""
    draw = random.Random(1)
    ratios = sorted(ratio(draw.choices(pairs, k=len(pairs))) for _ in range(times))
    return ratios[times // 20], ratios[-1 - times // 20]


def print_table(ours, theirs):
    print(f"\n{'late':>12} {'supercoild':>11} {'cyclictest':>11}")
    for name, share in SHARES.items():
        print(f"{name + ', us':>12} {quantile_us(ours, share):11} {quantile_us(theirs, share):11}")
    print(f"{'most, us':>12} {max(ours) + 1:11} {max(theirs) + 1:11}")
    for limit in LATE_US:
        counts = [sum(count for start, count in side.items() if start >= limit) for side in (ours, theirs)]
        print(f"{f'>= {limit} us':>12} {counts[0]:11} {counts[1]:11}")
    print(f"{'ticks':>12} {ours.total():11} {theirs.total():11}")


def outline(counts):
    """Each bin as a horizontal line; 0.5 stands for zero on a logarithmic axis."""
    for start in sorted(counts):
        yield from ([] if start - 1 in counts else [(max(start, 0.5), 0.5)])
        yield from ((max(start, 0.5), counts[start]), (start + 1, counts[start]))
        yield from ([] if start + 1 in counts else [(start + 1, 0.5)])


def plot(ours, theirs, title, file):
    data = "".join(f"${name} << EOD\n" + "".join(f"{x} {y}\n" for x, y in outline(counts)) + "EOD\n"
                   for name, counts in (("ours", ours), ("theirs", theirs)))
    script = f"""{data}set terminal svg size 900,360 noenhanced font 'sans-serif,12' background '#ffffff'
set output '{file}'
set title '{title}'
set xlabel 'us after its time'
set ylabel 'ticks'
set logscale xy
set yrange [0.5:*]
set grid lc rgb '#dddddd'
plot $theirs with lines lc rgb '#D55E00' title 'cyclictest', $ours with lines lc rgb '#0072B2' title 'supercoild'
"""
    subprocess.run(["gnuplot"], input=script, text=True, check=True)
    print(f"plot: {file}")


def parsed():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ticks", type=int, default=1_000_000, help="of each side [%(default)s]: twice so many ms")
    parser.add_argument("--slice", type=int, default=20_000, help="ticks of a turn [%(default)s]")
    parser.add_argument("--priority", type=int, default=80, help="of SCHED_FIFO [%(default)s]")
    parser.add_argument("--cpu", type=int, help="pin both to this CPU [any]")
    parser.add_argument("--plot", metavar="SVG", default="latency_ratio.svg", help="[%(default)s]")
    options = parser.parse_args()
    options.slice = min(options.slice, options.ticks)
    for program, package in (("cyclictest", "rt-tests"), ("gnuplot", "gnuplot-nox")):
        if not shutil.which(program):
            sys.exit(f"{program} is not installed (toolchain/setup tests, or Debian: apt install {package})")
    return options


def main():
    options = parsed()
    turns = -(-options.ticks // options.slice)
    pairs = []
    for turn in range(turns):
        sides = [supercoild, cyclictest]
        # They take turns at beginning, so that neither always follows the other.
        order = sides if turn % 2 == 0 else sides[::-1]
        slices = {side: side(options.slice, options) for side in order}
        pairs.append([slices[side] for side in sides])
        summaries = [f"p50 {quantile_us(side, 0.5)}, p99.99 {quantile_us(side, 0.9999)}, most {max(side) + 1}"
                     for side in pairs[-1]]
        print(f"{turn + 1} of {turns}: supercoild {summaries[0]} us; cyclictest {summaries[1]} us", flush=True)
    ours, theirs = (sum(side, collections.Counter()) for side in zip(*pairs))
    print_table(ours, theirs)
    now, (low, high) = ratio(pairs), uncertainty(pairs)
    print(f"\nratio of p99.99: {now:.3f} (90 % of resamplings: {low:.3f} to {high:.3f}); goal: at most {GOAL}: "
          f"{'reached' if now <= GOAL else 'MISSED'}")
    plot(ours, theirs, f"{ours.total()} ticks of each at {RATE_HZ} Hz, priority {options.priority} of SCHED_FIFO",
         options.plot)


if __name__ == "__main__":
    main()
