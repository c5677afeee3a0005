"""The results of the mutants, stored line by line, so that a run can be interrupted and continued at any time."""

import collections
import json
import threading
import tomllib

from scipy.stats import beta

from sample import Mutant

CONFIDENCE = 0.95


class Results:
    def __init__(self, path, of, tests, known):
        """`of` names code, seed and number of strata: results for any other are set aside. If the tests have only grown
        since, killed mutants stay killed, mutants that did not compile or gave the same code stay so, and survivors are
        tried again. Mutants tried only on the nearest program are open. If a line of the tests is gone, nothing is kept.
        `known`: the equivalents."""
        self.path = path
        self.lock = threading.Lock()
        self.rows = []
        lines = path.read_text().splitlines() if path.exists() else []
        before = json.loads(lines[0]) if lines else {}
        if before.get("of") == of and only_grew(before["tests"], tests):
            rows = [json.loads(line) for line in lines[1:] if line.endswith("}")]
            same_tests = before["tests"] == tests
            stays = {"equivalent": lambda row: key_of(row) in known, "open": lambda row: False,
                     "survived": lambda row: same_tests and key_of(row) not in known}
            self.rows = [row for row in rows if stays.get(row["verdict"], lambda row: True)(row)]
        elif lines:
            path.rename(path.with_suffix(".earlier.jsonl"))
        header = {"of": of, "tests": tests}
        path.write_text("".join(json.dumps(each) + "\n" for each in (header, *self.rows)))

    def add(self, stratum, mutant, area, verdict, by, took_s):
        row = {"stratum": stratum, "area": area, "file": mutant.file, "line": mutant.line, "before": mutant.before,
               "after": mutant.after, "verdict": verdict, "by": by, "took_s": round(took_s, 1)}
        with self.lock:
            self.rows.append(row)
            with open(self.path, "a") as file:
                file.write(json.dumps(row) + "\n")

    def tried(self, stratum):
        return {(row["line"], row["file"], row["after"]) for row in self.rows if row["stratum"] == stratum}

    def decided(self, stratum):
        return any(row["stratum"] == stratum and row["verdict"] in ("killed", "survived") for row in self.rows)


def mutant_of(row):
    return Mutant(row["file"], row["line"], row["before"], row["after"])


def key_of(row):
    return mutant_of(row).key()


def only_grew(before, now):
    """Whether every line of every file is still there, in the same order."""
    for name, lines in before.items():
        rest = iter(now.get(name, []))
        if not all(line in rest for line in lines):
            return False
    return True


def interval(killed, counted):
    """The Clopper-Pearson interval of the fraction that is killed."""
    tail = (1.0 - CONFIDENCE) / 2.0
    low = beta.ppf(tail, killed, counted - killed + 1) if killed > 0 else 0.0
    high = beta.ppf(1.0 - tail, killed + 1, counted - killed) if killed < counted else 1.0
    return float(low), float(high)


def equivalents(folder):
    """The equivalents from all files in the folder, by what the mutant changes; each must have a reason."""
    reasons = {}
    for path in sorted(folder.glob("*.toml")):
        for each in tomllib.loads(path.read_text()).get("equivalent", []):
            if not each.get("reason", "").strip():
                raise SystemExit(f"{path}: an equivalent in {each['file']} has no reason")
            reasons[each["file"], each["before"], each["after"]] = each["reason"]
    return reasons


def report(results, strata):
    """Prints the figures; returns the lower end of the interval of the killed fraction."""
    count = collections.Counter((row["area"], row["verdict"]) for row in results.rows)
    print(f"\n{'area':20} {'killed':>7} {'survived':>9} {'equivalent':>11} {'same code':>10} {'not compiled':>13}")
    for area in sorted({row["area"] for row in results.rows}):
        print(f"{area:20} {count[area, 'killed']:7} {count[area, 'survived']:9} {count[area, 'equivalent']:11} "
              f"{count[area, 'same code']:10} {count[area, 'invalid']:13}")
    survivors = [row for row in results.rows if row["verdict"] == "survived"]
    for row in survivors:
        print(f"\nsurvived: {mutant_of(row)}")
    killed = sum(row["verdict"] == "killed" for row in results.rows)
    counted = killed + len(survivors)
    if counted == 0:
        return 0.0
    low, high = interval(killed, counted)
    print(f"\n{counted} mutants of {strata} strata: {killed} killed, {100 * killed / counted:.1f} % "
          f"({100 * CONFIDENCE:.0f} %: {100 * low:.1f} to {100 * high:.1f} %)")
    return low
