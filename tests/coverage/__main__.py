"""Judges what gcovr measured: a table by folder, and the safety code at 100 % or each exception listed with its reason.

Lines and condition outcomes count: an outcome is one condition of a decision that was seen to decide it, as true or as
false (masking MC/DC). exceptions.toml lists what cannot be reached, by the line's text, and which files are judged.
"""

import argparse
import collections
import json
import pathlib
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXCEPTIONS = pathlib.Path(__file__).with_name("exceptions.toml")
Counts = collections.namedtuple("Counts", "lines lines_reached branches branches_reached outcomes outcomes_reached")


def counts_of(lines):
    branches = [branch for line in lines for branch in line.get("branches", [])]
    conditions = [condition for line in lines for condition in line.get("conditions", [])]
    return Counts(len(lines), sum(line["count"] > 0 for line in lines),
                  len(branches), sum(branch["count"] > 0 for branch in branches),
                  sum(condition["count"] for condition in conditions), sum(condition["covered"] for condition in conditions))


def is_missed(line):
    return line["count"] == 0 or any(condition["covered"] < condition["count"] for condition in line.get("conditions", []))


def reached(part, all_of_it):
    return f"{100.0 * part / all_of_it:.1f} %" if all_of_it else "-"


def table(files):
    folders = collections.defaultdict(list)
    for file in files:
        folders[str(pathlib.PurePath(file["file"]).parent)] += file["lines"]
    folders["all"] = [line for lines in list(folders.values()) for line in lines]
    yield f"{'':52} {'lines':>8} {'branches':>9} {'outcomes':>9}"
    for folder, lines in folders.items():
        c = counts_of(lines)
        yield (f"{folder:52} {reached(c.lines_reached, c.lines):>8} {reached(c.branches_reached, c.branches):>9} "
               f"{reached(c.outcomes_reached, c.outcomes):>9}")


def is_judged(file, judged):
    return any(pathlib.PurePath(file).is_relative_to(path) for path in judged)


def problems(files, exceptions):
    """What is missed and not listed, and what is listed and not missed."""
    listed = {(e["file"], e["line"]): e["reason"] for e in exceptions["exception"]}
    used = set()
    for file in files:
        if not is_judged(file["file"], exceptions["judged"]):
            continue
        text = (ROOT / file["file"]).read_text().splitlines()
        for line in filter(is_missed, file["lines"]):
            key = (file["file"], text[line["line_number"] - 1].strip())
            if key in listed:
                used.add(key)
                continue
            seen = ", ".join(f"{c['covered']} of {c['count']} outcomes" for c in line.get("conditions", []))
            yield f"{file['file']}:{line['line_number']}: {'never run' if line['count'] == 0 else seen}: {key[1]}"
    for file, line in listed.keys() - used:
        yield f"{EXCEPTIONS.name}: {file}: is reached, or is not there: {line}"


def unmeasured(files, judged):
    """A path that names nothing would judge nothing."""
    for path in judged:
        if not any(is_judged(file["file"], [path]) for file in files):
            yield f"{EXCEPTIONS.name}: nothing was measured of {path}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("measured", type=pathlib.Path, help="as gcovr --json writes it")
    files = json.loads(parser.parse_args().measured.read_text())["files"]
    exceptions = tomllib.loads(EXCEPTIONS.read_text())
    print("\n".join(table(files)))
    wrong = [*unmeasured(files, exceptions["judged"]), *problems(files, exceptions)]
    judged = counts_of([line for file in files if is_judged(file["file"], exceptions["judged"]) for line in file["lines"]])
    print(f"\nsafety code: {judged.lines_reached} of {judged.lines} lines, {judged.outcomes_reached} of {judged.outcomes} "
          f"condition outcomes; {len(exceptions['exception'])} exceptions are listed")
    print("\n".join(wrong))
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
