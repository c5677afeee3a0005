"""Runs of the continuous MRAC, and theta* by solving the matching identity."""

import dataclasses

import numpy as np

import mrac_ode
from muscle import Muscle, random_muscle

TIMES = np.arange(1.0, 31.0)


def run(name, preset, factor, model, limits):
    """Without freezing at the limits, where the frozen law chatters and has no continuous solution."""
    muscle = Muscle()
    constants = dataclasses.replace(mrac_ode.design(preset, factor), model=model,
                                    limits=limits)
    result = mrac_ode.simulate(constants, muscle, mrac_ode.sine(muscle), TIMES)
    return {"name": name, "preset": preset, "factor": factor, "model": model,
            "min_W": max(limits[0], -1e3), "max_W": min(limits[1], 1e3),
            "time_s": TIMES.tolist(),
            **{key: value.tolist() for key, value in result.items()}}


def matching(muscle, alpha, lambda_, model):
    """theta* from (lambda - theta1 alpha) R - b3 (theta2 alpha + theta3 lambda) = lambda Rm."""
    denominator, gain = mrac_ode.MODELS[model]
    r = muscle.denominator() / muscle.denominator()[0]
    b3 = r[-1]  # position in watts at rest
    alphas = [np.array([alpha[0], 0.0]), np.array([alpha[1]])]
    columns = [*(np.polymul(a, r) for a in alphas), *(b3 * a for a in alphas),
               b3 * np.array(lambda_)]
    matrix = np.column_stack([np.pad(c, (6 - len(c), 0)) for c in columns])
    target = np.polymul(lambda_, r) - np.polymul(lambda_, denominator)
    theta, _, rank, _ = np.linalg.lstsq(matrix[1:], target[1:], rcond=None)
    assert rank == 5 and np.max(np.abs(matrix @ theta - target)) < 1e-6 * np.max(np.abs(target))
    compensator = np.polysub(lambda_, np.polyadd(theta[0] * alphas[0], theta[1] * alphas[1]))
    return {"parameters": muscle.as_dict(), "alpha": list(alpha), "lambda": list(lambda_[::-1]),
            "model": model, "theta": [*theta.tolist(), gain / b3],
            "compensator_stable": bool(np.all(np.roots(compensator).real < 0.0))}


def cases():
    rng = np.random.default_rng(5)
    unlimited, real = (-np.inf, np.inf), (0.0, 4.5)
    matches = [matching(muscle, alpha, lambda_, model)
               for muscle in [Muscle()] + [random_muscle(rng) for _ in range(5)]
               for alpha, lambda_ in (((1.0, 1.0), (1.0, 3.0, 2.0)),
                                      ((20.0, 400.0), (1.0, 40.0, 400.0)))
               for model in mrac_ode.MODELS]
    return {
        "runs": [
            run("printed x 10", "printed", 10.0, "wm16", unlimited),
            run("printed x 10, eq8, clipped", "printed", 10.0, "eq8", real),
            run("a", "a", 20.0, "wm16", unlimited),
            run("a, clipped", "a", 20.0, "wm16", real),
        ],
        "matching": matches,
    }
