"""Holds by scipy, stability by numpy.roots, positive realness by a sweep over frequency."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.signal import cont2discrete

from muscle import Muscle


def ramp_matrices(a, b, step):
    """x[k+1] = transition x[k] + start u[k] + end u[k+1] by integrating over one step."""
    order, inputs = b.shape

    def run(initial, first, last):
        return solve_ivp(lambda t, x: a @ x + b @ (first + (last - first) * t / step), (0.0, step),
                         initial, method="DOP853", rtol=1e-12, atol=1e-16).y[:, -1]

    zero, none = np.zeros(order), np.zeros(inputs)
    transition = np.column_stack([run(e, none, none) for e in np.eye(order)])
    start = np.column_stack([run(zero, e, none) for e in np.eye(inputs)])
    end = np.column_stack([run(zero, none, e) for e in np.eye(inputs)])
    return transition, start, end


def hold_case(a, b, step):
    order, inputs = b.shape
    zero = cont2discrete((a, b, np.eye(order), np.zeros((order, inputs))), step, method="zoh")
    transition, start, end = ramp_matrices(a, b, step)
    return {"a": a.tolist(), "b": b.tolist(), "step_s": step,
            "zoh": {"transition": zero[0].tolist(), "held": zero[1].tolist()},
            "foh": {"transition": transition.tolist(), "start": start.tolist(),
                    "end": end.tolist()}}


def hold_cases(rng):
    a, b = Muscle().state_space()
    result = [hold_case(a, b, step) for step in (1e-3, 1e-2, 0.1)]
    for step in (1e-3, 1e-2, 0.1, 0.5):
        for _ in range(3):
            result.append(hold_case(rng.normal(size=(3, 3)) * 3.0, rng.normal(size=(3, 2)), step))
    return result


def hurwitz_cases(rng):
    """Random polynomials, and products of random factors, which are stable far more often."""
    result = []
    for degree in range(2, 6):
        for index in range(200):
            if index % 2:
                c = rng.normal(size=degree + 1) + 0.7
            else:
                c = np.array([rng.uniform(0.2, 3.0)])
                while len(c) <= degree:
                    room = degree + 1 - len(c)
                    pair = [1.0, rng.uniform(-0.4, 2.0), rng.uniform(0.05, 4.0)]
                    c = np.polymul(c, pair if room >= 2 else [1.0, rng.uniform(-0.2, 2.0)])
            roots = np.roots(c)
            if np.min(np.abs(roots.real)) < 1e-6:
                continue  # rounding alone decides
            result.append({"ascending": c[::-1].tolist(),
                           "hurwitz": bool(c[0] > 0.0 and np.all(roots.real < 0.0))})
    return result


def realness_cases(rng):
    """The minimum of Re N(jw) D(-jw) over a fine sweep of w, for stable D."""
    omega = np.concatenate([[0.0], np.logspace(-3, 3, 60001)])
    s = 1j * omega
    result = []
    while len(result) < 60:
        numerator = rng.uniform(0.0, 3.0, size=3)
        d = np.polymul([1.0, rng.uniform(0.1, 3.0)],
                       [1.0, rng.uniform(0.1, 3.0), rng.uniform(0.1, 4.0)])
        value = (np.polyval(numerator, s) * np.conj(np.polyval(d, s))).real
        limit = numerator[0] * d[1] - numerator[1]  # of w^2 Re G for w -> infinity
        # Cases in which the sweep is too coarse or too short to decide are left out.
        too_close = abs(np.min(value)) < 1e-3 or abs(limit) < 1e-2
        if limit > 0 and (too_close or omega[np.argmin(value)] > 300.0):
            continue
        result.append({
            "numerator": numerator[::-1].tolist(), "denominator": d[::-1].tolist(),
            "min_real_part": float(np.min(value)) if limit > 0 else None,
            "strict": bool(limit > 0 and np.min(value) > 0),
        })
    return result


def cases():
    rng = np.random.default_rng(2)
    return {"holds": hold_cases(rng), "hurwitz": hurwitz_cases(rng),
            "realness": realness_cases(rng)}
