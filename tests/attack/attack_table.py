"""Judges what the program `attacks` saw, and compares it with docs/attacks.md and docs/safety.md.

Each run must stay below the muscle's limit, and the published interval must hold the true temperature, unless
attacks.cpp names the part of the board that protects then, or says why the interval cannot know. --update writes the
tables again. --every N does every Nth run and only judges: for sanitizers, which are too slow for all.
"""

import argparse
import collections
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIMIT_C = 160.0
# From the crossing of the limit to the heater being off.
OVERSHOOT_K = 0.5
# Tolerance for the rounding of a reading.
HELD_K = 0.05

MUSCLES = ("soft", "stiff")
JOINTS = ("soft joint", "stiff joint")
BUNDLES = ("soft bundle", "stiff bundle")

Run = collections.namedtuple("Run", "board attack activity hottest_C outside_K fault fault_s guard blindness")


def runs_of(program, every):
    text = subprocess.run([program, str(every)], check=True, capture_output=True, text=True).stdout
    for line in text.splitlines():
        board, attack, activity, hottest, outside, fault, fault_s, guard, blindness = line.split(";")
        yield Run(board, attack, activity, float(hottest), float(outside), fault, float(fault_s), guard, blindness)


def kept(run):
    return run.hottest_C <= LIMIT_C + OVERSHOOT_K


def held(run):
    return run.outside_K <= HELD_K


def problems(runs):
    for run in runs:
        what = f"{run.board}, {run.attack}, {run.activity}"
        if not kept(run) and not run.guard:
            yield f"{what}: {run.hottest_C} °C, and nothing protects"
        if not held(run) and not run.blindness:
            yield f"{what}: {run.outside_K} K outside of the published interval"


def by_attack(runs, boards):
    groups = collections.defaultdict(list)
    for run in runs:
        if run.board in boards:
            groups[run.attack].append(run)
    return groups


def summary(runs, boards, faults=False):
    """boards: two of them, one column each."""
    yield "| attack | hottest, soft | hottest, stiff | interval | protects |" + (" ends with |" if faults else "")
    yield "|---|---|---|---|---|" + ("---|" if faults else "")
    for attack, group in by_attack(runs, boards).items():
        hottest = " | ".join(f"{max(run.hottest_C for run in group if run.board == board):.0f} °C" for board in boards)
        outside = max(r.outside_K for r in group)
        interval = "holds" if all(map(held, group)) else f"off by {outside:.1f} K"
        over = [run for run in group if not kept(run)]
        protects = f"**{over[0].guard}**{only_while(over)}" if over else "firmware"
        yield f"| {attack} | {hottest} | {interval} | {protects} |" + (f" {endings(group)} |" if faults else "")


def endings(group):
    """Each fault with its times and how many runs it ended."""
    times = collections.defaultdict(list)
    for run in group:
        if run.fault:
            times[run.fault].append(run.fault_s)
    parts = [f"[{fault}](faults/{fault}.md) {span(seconds)} ({len(seconds)})" for fault, seconds in times.items()]
    if going_on := sum(not run.fault for run in group):
        parts.append(f"– ({going_on})")
    return ", ".join(parts)


def span(seconds):
    first, last = f"{min(seconds):.1f}", f"{max(seconds):.1f}"
    return f"{first} s" if first == last else f"{first} to {last} s"


def table(runs, muscle):
    yield "| attack | while | hottest | interval | fault | after |"
    yield "|---|---|---|---|---|---|"
    for run in runs:
        if run.board != muscle:
            continue
        hottest = f"{run.hottest_C:.0f} °C" if kept(run) else f"**{run.hottest_C:.0f} °C**"
        interval = "holds" if held(run) else f"off by {run.outside_K:.1f} K"
        fault = f"[{run.fault}](faults/{run.fault}.md)" if run.fault else "–"
        after = f"{run.fault_s:.1f} s" if run.fault else "–"
        yield f"| {run.attack} | {run.activity} | {hottest} | {interval} | {fault} | {after} |"


def only_while(over):
    """The activity, when only one leads over the limit."""
    activities = {run.activity for run in over}
    return f", in {activities.pop()} only" if len(activities) == 1 else ""


def sentence(text):
    return text[0].upper() + text[1:] + "."


def unprotected(runs, boards):
    """For safety.md."""
    for attack, group in by_attack(runs, boards).items():
        over = [run for run in group if not kept(run)]
        missed = [run for run in group if not held(run)]
        if over:
            hottest = max(run.hottest_C for run in over)
            yield f"- **{attack}**: {hottest:.0f} °C{only_while(over)}. Protects: the {over[0].guard}. {sentence(missed[0].blindness)}"
        elif missed:
            outside = max(run.outside_K for run in missed)
            yield f"- {attack}: up to {outside:.1f} K outside of the published interval. {sentence(missed[0].blindness)}"


def with_section(text, name, lines):
    """The text with what is between <!-- name --> and <!-- end of name --> replaced."""
    begin, end = f"<!-- {name}: made by tests/attack -->\n", f"<!-- end of {name} -->"
    if text.count(begin) != 1 or text.count(end) != 1:
        sys.exit(f"the marks {begin.strip()} and {end} are missing")
    before, rest = text.split(begin)
    return before + begin + "\n" + "\n".join(lines) + "\n\n" + end + rest.split(end)[1]


def pages(runs):
    attacks, safety = ROOT / "docs/attacks.md", ROOT / "docs/safety.md"
    text = with_section(attacks.read_text(), "summary", summary(runs, MUSCLES))
    text = with_section(text, "joints", summary(runs, JOINTS, faults=True))
    text = with_section(text, "bundles", summary(runs, BUNDLES, faults=True))
    for muscle in MUSCLES:
        text = with_section(text, muscle, table(runs, muscle))
    yield attacks, text
    text = with_section(safety.read_text(), "unprotected attacks", unprotected(runs, MUSCLES))
    text = with_section(text, "unprotected attacks on joints", unprotected(runs, JOINTS))
    yield safety, with_section(text, "unprotected attacks on bundles", unprotected(runs, BUNDLES))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="attacks")
    parser.add_argument("--every", type=int, default=1, help="judge every Nth run, and compare nothing")
    parser.add_argument("--update", action="store_true", help="write the tables in docs")
    arguments = parser.parse_args()
    runs = list(runs_of(arguments.program, arguments.every))
    wrong = list(problems(runs))
    if not runs:
        wrong.append("no runs")
    if arguments.every == 1 and not wrong:
        for page, text in pages(runs):
            if arguments.update:
                page.write_text(text)
            elif page.read_text() != text:
                wrong.append(f"{page.relative_to(ROOT)} is not what the attacks gave: run this with --update, and look")
    over = sum(not kept(run) for run in runs)
    print("\n".join(wrong) or f"{len(runs)} runs: {len(runs) - over} stay below {LIMIT_C:.0f} °C, {over} are guarded")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
