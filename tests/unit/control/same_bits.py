"""Compiles fixed_bits.cpp with every compiler and optimisation and compares the outputs.

Fixed-point results must be the same to the bit for every compiler, so that a simulation on a PC
is valid for the board.
"""

import argparse
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

# Without the files for other arithmetics only, or for all of them.
LIBRARY = ("actuator/conversions.cpp", "actuator/parameters.cpp", "actuator/state_space.cpp",
           "linear/discretize.cpp", "linear/matrix_exponential.cpp", "linear/polynomial.cpp",
           "tracking/mrac.cpp", "tracking/mrac_matching.cpp", "tracking/mrac_premises.cpp",
           "tracking/reference_model.cpp")
VARIANTS = [("g++", "-O0"), ("g++", "-O2"), ("clang++", "-O0"), ("clang++", "-O2")]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True, help="of the repository")
    parser.add_argument("--eigen", required=True, help="include folder of Eigen")
    arguments = parser.parse_args()
    for compiler in sorted({compiler for compiler, _ in VARIANTS}):
        if shutil.which(compiler) is None:
            sys.exit(f"{compiler} is not installed: that both compilers give the same bits cannot "
                     "be shown (Debian: apt install g++ clang)")
    root = arguments.root
    sources = [*(root / "control/src" / name for name in LIBRARY), root / "tests/unit/control/fixed_bits.cpp"]
    flags = ["-std=c++20", "-ffp-contract=off", "-DEIGEN_DONT_VECTORIZE", "-w",
             "-isystem", arguments.eigen, "-I", root / "control/include", "-I", root / "tests"]
    with tempfile.TemporaryDirectory() as folder:
        # All in one unit, because Eigen's headers take most of the compile time.
        unit = pathlib.Path(folder) / "all.cpp"
        unit.write_text("".join(f'#include "{source}"\n' for source in sources))

        def output_of(variant):
            compiler, level = variant
            program = pathlib.Path(folder) / f"bits_{compiler}_{level[1:]}"
            subprocess.run([compiler, level, *flags, unit, "-o", program], check=True)
            return subprocess.run([program], check=True, capture_output=True, text=True).stdout

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            outputs = list(pool.map(output_of, VARIANTS))
    for variant, output in zip(VARIANTS, outputs):
        print(*variant, output, sep="\n")
    if len(set(outputs)) != 1:
        sys.exit("the results differ")
    print("the same bits from all")


if __name__ == "__main__":
    main()
