"""Changes single lines of supervisor, board, loop, telemetry commands, storage and Linux HAL, and checks whether the
nearest test programs notice.

The lines are divided into runs of equal length. One mutant per run is drawn (universalmutator makes them), compiled
and tried. A mutant that does not compile, compiles to the same code, or is listed in tests/mutants/equivalent is
replaced by the next one of its run. Everything happens on copies in build/mutate. The files of tests in each program
are tried one after the other, the nearest first.

The same command continues an interrupted run. If since then only lines were added to tests/unit and tests/loop, or only
texts and tests/mutants/equivalent changed, killed mutants stay killed, because a test that failed still fails, and
survivors are tried again. If any other file changed, or a line of a test is gone, everything starts from scratch.
"""

import argparse
import os
import pathlib
import queue
import random
import sys
import threading
import time

from areas import AREAS, files_of
from results import Results, equivalents, report
from sample import strata
from workshop import Failed, Workshop, code_hash, tests_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "build" / "mutate"
CORES = len(os.sched_getaffinity(0))
LEAST_KILLED = 0.90  # for the lower end of the interval
AREA_OF = {file: area for area in AREAS for file in files_of(area, ROOT)}


def arguments():
    parser = argparse.ArgumentParser(prog="toolchain/mutate", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=420,
                        help="runs of lines; at most one mutant of each counts (default: 420)")
    parser.add_argument("--seed", type=int, default=1, help="of the sample (default: 1)")
    parser.add_argument("--jobs", type=int, default=2, help="mutants at a time, each in a copy of its own (default: 2)")
    parser.add_argument("--minutes", type=float, default=120.0, help="begin no mutant after so long (default: 120)")
    parser.add_argument("--patience", type=float, default=300.0, metavar="SECONDS",
                        help="what no test noticed after so long has survived (default: 300)")
    parser.add_argument("--only", metavar="TEXT", default="", help="files whose path contains this")
    parser.add_argument("--nearest", action="store_true",
                        help="build and ask only the nearest program of each area: what it does not notice stays "
                             "undecided")
    parser.add_argument("--in-order", action="store_true",
                        help="area after area, the supervisor first (default: in random order, so that what was tried "
                             "in a part of the time is a sample as well)")
    parser.add_argument("--list", action="store_true", help="print the first mutant of each run, and try none")
    parser.add_argument("--report", action="store_true", help="print the figures of the last run, and try none")
    return parser.parse_args()


class Run:
    def __init__(self, options):
        self.options = options
        files = [file for file in AREA_OF if options.only in file]
        self.runs, self.lines = strata(files, ROOT, options.count, options.seed)
        self.programs_of = {area: area.programs[:1] if options.nearest else area.programs for area in AREAS}
        areas = {AREA_OF[run[0].file] for run in self.runs}
        self.programs = list(dict.fromkeys(program for area in AREAS if area in areas
                                           for program in self.programs_of[area]))
        self.known = equivalents(pathlib.Path(__file__).parent / "equivalent")
        FOLDER.mkdir(parents=True, exist_ok=True)
        self.results = Results(FOLDER / "results.jsonl", [code_hash(ROOT), options.seed, len(self.runs), options.only],
                               tests_of(ROOT), self.known)
        self.ends = time.monotonic() + 60.0 * options.minutes
        self.problems = []
        self.green = {}
        self.preparing = threading.Lock()

    def by_file(self):
        """Undecided runs, grouped by the file of their first mutant, so that each file is restored only once."""
        waiting = {}
        for number, run in enumerate(self.runs):
            if not self.results.decided(number):
                waiting.setdefault(run[0].file, []).append(number)
        return waiting

    def try_all(self):
        todo = queue.Queue()
        groups = list(self.by_file().values())
        if not self.options.in_order:
            random.Random(self.options.seed).shuffle(groups)
        for group in groups:
            todo.put(group)
        workers = [threading.Thread(target=self.work, args=(i, todo)) for i in range(self.options.jobs)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        if self.problems:
            raise Failed("\n".join(self.problems))

    def work(self, number, todo):
        try:
            shop = Workshop(ROOT, FOLDER / str(number), self.programs, max(1, CORES // self.options.jobs),
                            self.green)
            with self.preparing:  # a compiler cache then has the objects for the second copy
                shop.prepare(CORES, lambda text: print(f"copy {number}: {text}", flush=True))
            while time.monotonic() < self.ends:
                for stratum in todo.get_nowait():
                    self.try_stratum(shop, stratum)
            shop.restore()
        except queue.Empty:
            shop.restore()
        except Failed as problem:
            self.problems.append(str(problem))

    def try_stratum(self, shop, stratum):
        tried = self.results.tried(stratum)
        for mutant in self.runs[stratum]:
            if time.monotonic() > self.ends:
                return
            if (mutant.line, mutant.file, mutant.after) in tried:
                continue
            start = time.monotonic()
            area = AREA_OF[mutant.file]
            verdict, by = ("equivalent", "") if mutant.key() in self.known else \
                shop.judge(mutant, self.programs_of[area], self.options.patience)
            if verdict == "survived" and self.options.nearest:
                verdict = "open"
            self.results.add(stratum, mutant, area.name, verdict, by, time.monotonic() - start)
            if verdict in ("killed", "survived", "open"):
                self.tell(stratum, mutant, verdict, by, time.monotonic() - start)
                return

    def unfinished(self):
        """The number of undecided runs with mutants that have not been tried."""
        return sum(not self.results.decided(number) and len(self.results.tried(number)) < len(run)
                   for number, run in enumerate(self.runs))

    def tell(self, stratum, mutant, verdict, by, took_s):
        decided = len({row["stratum"] for row in self.results.rows if row["verdict"] in ("killed", "survived")})
        what = f"killed by {by}" if by else verdict
        print(f"[{decided}/{len(self.runs)}] {what} in {took_s:.0f} s: {mutant}", flush=True)


def main():
    options = arguments()
    run = Run(options)
    if options.list:
        for mutants in run.runs:
            print(mutants[0])
        print(f"{len(run.runs)} runs of {run.lines} lines")
        return 0
    if not options.report:
        try:
            run.try_all()
        except Failed as problem:
            print(f"toolchain/mutate: {problem}", file=sys.stderr)
            return 1
    low = report(run.results, len(run.runs))
    print(f"the lower end must be at least {100 * LEAST_KILLED:.0f} %")
    if unfinished := run.unfinished():
        print(f"{unfinished} runs of lines are not finished: the same command carries on with them")
    return 0 if low >= LEAST_KILLED and unfinished == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
