"""The gradient estimator of Eq. (4) as a differential equation with its muscle and filters."""

import numpy as np
from scipy.integrate import solve_ivp

from muscle import Muscle

LAMBDA_LOW = np.array([10.0, 9.0, 6.0])  # of s^3 + 6 s^2 + 9 s + 10, ascending
GAIN = 1e7 * np.array([0.6, 0.4, 0.7, 0.09])
INITIAL = np.array([0.1, 5.0, 30.0, 20.0])


def eq18(t):
    return np.sin(t) + np.sin(0.5 * t) + np.sin(0.25 * t) + 2.5


def gradient(times):
    muscle = Muscle()
    a, b = muscle.state_space()

    def slope(t, state):
        plant, z, x, theta = state[:3], state[3:6], state[6:9], state[9:]
        power, position = eq18(t), plant[1]
        phi = np.array([muscle.moving_mass_kg * (position - LAMBDA_LOW @ x), x[2], x[1], x[0]])
        return np.concatenate([
            a @ plant + b[:, 0] * power,
            [z[1], z[2], power - LAMBDA_LOW @ z],
            [x[1], x[2], position - LAMBDA_LOW @ x],
            GAIN * phi * (z[0] - theta @ phi),
        ])

    start = np.concatenate([np.zeros(9), INITIAL])
    solution = solve_ivp(slope, (0.0, times[-1]), start, method="LSODA", rtol=1e-10, atol=1e-13,
                         t_eval=times)
    return {"time_s": times.tolist(), "theta": solution.y[9:].T.tolist()}


def cases():
    return {"gradient": gradient(np.arange(1.0, 31.0))}
