"""Proves that the interval observer's ends hold the true temperature over one step, whatever the muscle and its power are.

The formulas come from the code: interval_trace runs control::BasicIntervalObserver on symbols. z3 then looks, over the
reals, for a muscle within the bounds, a power within its bounds and a rise within the interval whose rise is outside of
the interval one step later. There is none. docs/safety.md has the argument in words: what the truth is, the two
lemmas on exponentials that replace them here, and what rounding adds, which is measured here against its bound.
"""

import decimal
import itertools
import json
import subprocess
import sys

import z3

from formula import decimals_of, exact, value_of

BOUNDS = ("mass_l", "mass_u", "transfer_l", "transfer_u", "step_s")
GIVEN = {name: z3.Real(name) for name in (*BOUNDS, "min_W", "max_W", "lowest", "highest")}
EXP = z3.Function("exponential", z3.RealSort(), z3.RealSort())

# The muscle: its parameters, its rise before the step, its mean power over the step (each moment weighted by what is
# left of it at the end: a power between bounds has a mean between them), and exp(-transfer/mass * step_s).
MASS, TRANSFER, RISE, POWER, DECAY = z3.Reals("mass transfer rise power decay")
TRUTH = "(+ (* rise decay) (/ (* power (- 1 decay)) transfer))"

# Unit roundoff of a double.
ROUNDOFF = decimal.Decimal(2) ** -53


def parsed(text, sort="result"):
    names = {**GIVEN, "exponential": EXP, "result": z3.Real("result"),
             "mass": MASS, "transfer": TRANSFER, "rise": RISE, "power": POWER, "decay": DECAY}
    whole = f"(assert (= result {text}))" if sort == "result" else f"(assert {text})"
    assertion = z3.parse_smt2_string(whole, decls=names)[0]
    return assertion.arg(1) if sort == "result" else assertion


def premises():
    g = GIVEN
    return [0 < g["mass_l"], g["mass_l"] <= MASS, MASS <= g["mass_u"],
            0 < g["transfer_l"], g["transfer_l"] <= TRANSFER, TRANSFER <= g["transfer_u"],
            0 < g["step_s"], 0 <= g["min_W"], g["min_W"] <= POWER, POWER <= g["max_W"],
            0 <= g["lowest"], g["lowest"] <= RISE, RISE <= g["highest"]]


def exponentials(expression):
    if expression.decl().eq(EXP):
        yield expression
    for child in expression.children():
        yield from exponentials(child)


def bounds_of(exponential):
    """(transfer, mass) such that it is exp(-transfer/mass * step_s)."""
    g = GIVEN
    for transfer, mass in itertools.product(("transfer_l", "transfer_u"), ("mass_l", "mass_u")):
        solver = z3.Solver()
        solver.add(g["mass_l"] > 0, g["mass_u"] > 0, exponential.arg(0) != -g[transfer] / g[mass] * g["step_s"])
        if solver.check() == z3.unsat:
            return g[transfer], g[mass]
    sys.exit(f"{exponential} is not exp(-transfer/mass * step_s) of any two bounds")


def without_exponentials(expression):
    """The expression with a variable for each exponential, and (transfer, mass, variable) of each of them."""
    found = {str(e): e for e in exponentials(expression)}
    terms, variables = [], []
    for index, exponential in enumerate(found.values()):
        variable = z3.Real(f"decay_{index}")
        variables.append((exponential, variable))
        terms.append((*bounds_of(exponential), variable))
    if not terms:
        sys.exit(f"no exponential in {expression}: has the observer changed?")
    return z3.substitute(expression, *variables), terms


def lemmas(terms, chord):
    """What is true of any exponentials exp(-transfer/mass * step_s)."""
    for _, _, decay in terms:
        yield z3.And(0 < decay, decay < 1)
    for (transfer_a, mass_a, a), (transfer_b, mass_b, b) in itertools.permutations(terms, 2):
        yield z3.Implies(transfer_a * mass_b >= transfer_b * mass_a, a <= b)
        if chord:
            heavier = z3.And(transfer_a >= transfer_b, mass_a >= mass_b)
            yield z3.Implies(heavier, (1 - a) * transfer_b <= (1 - b) * transfer_a)


def enclosures(terms):
    """exp(-x) for a short step, so tight that a counterexample also holds for real exponentials."""
    for transfer, mass, decay in terms:
        x = transfer * GIVEN["step_s"] / mass
        yield z3.And(10 * x <= 1, 1 - x <= decay, decay <= 1 - x + x * x / 2)


def search(path, end, chord=True, replaced=(), more=lambda terms: ()):
    """A case in which the truth leaves the interval at this end, within a minute; None when there is none."""
    formula, terms = without_exponentials(z3.substitute(parsed(path[end]), *replaced))
    terms.append((TRANSFER, MASS, DECAY))
    solver = z3.Solver()
    solver.set("timeout", 60_000)
    solver.add(*premises(), *lemmas(terms, chord), *more(terms))
    solver.add(*(z3.substitute(parsed(text, "condition"), *replaced) for text in path["when"]))
    if solver.check() != z3.sat:
        sys.exit(f"{path['when']}: no muscle is in this case: the proof would be of nothing")
    truth = parsed(TRUTH)
    solver.add(truth > formula if end == "highest" else truth < formula)
    outcome = solver.check()
    if outcome == z3.unknown:
        sys.exit(f"{end}, {path['when']}: z3 does not know: {solver.reason_unknown()}")
    return solver.model() if outcome == z3.sat else None


def prove(paths):
    for path, end in itertools.product(paths, ("highest", "lowest")):
        counterexample = search(path, end)
        if counterexample is not None:
            sys.exit(f"{end} does not hold the truth when {path['when']}:\n{counterexample}")
    print(f"both ends hold the truth over a step, in all {len(paths)} courses that it can take")


def refute_monotony_alone(paths):
    if all(search(path, "highest", chord=False) is None for path in paths):
        sys.exit("without its second lemma the proof holds too: is it still needed?")
    print("monotony alone does not prove it")


def refute_both_lower_bounds(paths):
    """With the lowest mass in both directions the observer cools too fast. Real exponentials confirm it."""
    both_lower = [(GIVEN["mass_u"], GIVEN["mass_l"])]
    for path in paths:
        # The bounds still contain the muscle: only the formula forgets the higher one.
        model = search(path, "highest", replaced=both_lower, more=enclosures)
        if model is None:
            continue
        names = [*GIVEN.values(), MASS, TRANSFER, RISE, POWER]
        values = {str(name): exact(model.eval(name, model_completion=True)) for name in names}
        values["decay"] = (-values["transfer"] / values["mass"] * values["step_s"]).exp()
        observed = value_of(path["highest"], {**values, "mass_u": values["mass_l"]})
        truth = value_of(TRUTH, values)
        if truth <= observed:
            sys.exit(f"z3's counterexample is none: {truth} K, observed {observed} K, {values}")
        print(f"an observer with both lower bounds is refuted: {truth:.6f} K are reported as at most {observed:.6f} K")
        return
    sys.exit("an observer with both lower bounds was not refuted")


def prove_slowest():
    """With the mass that RiseIntervalObserver::limit_time_constant gives, the hot end is passed by no muscle whose mass
    over heat transfer is at most tau: at each rise its rate is at least the muscle's, which is what the comparison
    principle asks."""
    g = GIVEN
    tau, rise, power = z3.Reals("tau rise power")
    bounded = g["transfer_l"] * tau
    slowest = z3.If(bounded < g["mass_l"], g["mass_l"], z3.If(bounded > g["mass_u"], g["mass_u"], bounded))
    flow = power - g["transfer_l"] * rise
    heating = flow > 0
    solver = z3.Solver()
    solver.set("timeout", 60_000)
    solver.add(0 < g["mass_l"], g["mass_l"] <= MASS, MASS <= g["mass_u"], 0 < tau, MASS <= tau * TRANSFER,
               0 < g["transfer_l"], g["transfer_l"] <= TRANSFER, 0 <= rise, 0 <= power)
    if solver.check() != z3.sat:
        sys.exit("no muscle is within bounds of its time constant: the proof would be of nothing")
    # (P - eta rise)/psi <= flow/mass, without the divisions.
    faster = (power - TRANSFER * rise) * z3.If(heating, g["mass_l"], slowest) > flow * MASS
    solver.add(faster)
    if solver.check() != z3.unsat:
        sys.exit(f"a muscle is faster than the hot end: {solver.model()}")
    print("a bound of the time constant holds the hot end's cooling")


def step_exactly(paths, values):
    """The traced formulas with 50 digits: (lowest, highest)."""
    for path in paths:
        if all(value_of(text, values) for text in path["when"]):
            return value_of(path["lowest"], values), value_of(path["highest"], values)
    sys.exit(f"no course for {values}")


def bound_rounding(paths, runs):
    """The class's doubles against the formulas; what docs/safety.md says that a step and all steps may add."""
    steps, worst_step, worst_sum = 0, 0.0, 0.0
    for run in runs:
        bounds = dict(zip(BOUNDS, decimals_of(run["bounds"])))
        x_max = bounds["transfer_u"] / bounds["mass_l"] * bounds["step_s"]
        x_min = bounds["transfer_l"] / bounds["mass_u"] * bounds["step_s"]
        (start,) = decimals_of([run["start"]])
        lowest, highest = decimal.Decimal(0), start
        ends = (lowest, highest)
        largest = start
        for numbers in run["steps"]:
            min_W, max_W, min_published, max_published = decimals_of(numbers)
            largest = max(largest, max_W / bounds["transfer_l"])
            allowed = (6 + 6 * x_max) * ROUNDOFF * largest
            values = {**bounds, "min_W": min_W, "max_W": max_W}
            once = step_exactly(paths, {**values, "lowest": lowest, "highest": highest})
            ends = step_exactly(paths, {**values, "lowest": ends[0], "highest": ends[1]})
            lowest, highest = min_published, max_published
            all_steps = allowed / (1 - (-x_min).exp())
            worst_step = max(worst_step, *(abs(a - b) / allowed for a, b in zip(once, (lowest, highest))))
            worst_sum = max(worst_sum, *(abs(a - b) / all_steps for a, b in zip(ends, (lowest, highest))))
            steps += 1
    print(f"{steps} steps in doubles: rounding takes {100 * worst_step:.0f} % of what is allowed for a step, "
          f"{100 * worst_sum:.1f} % of that for all")
    if worst_step > 1 or worst_sum > 1:
        sys.exit("rounding exceeds its bound")


def main():
    traced = json.loads(subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout)
    prove(traced["paths"])
    refute_monotony_alone(traced["paths"])
    refute_both_lower_bounds(traced["paths"])
    prove_slowest()
    bound_rounding(traced["paths"], traced["runs"])


if __name__ == "__main__":
    main()
