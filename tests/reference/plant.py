"""Long runs of random muscles under random power and load, for the simulated plant."""

import numpy as np
from scipy.integrate import solve_ivp

from muscle import random_muscle

HOLD_S = 0.5
HOLDS = 240


def cases():
    rng = np.random.default_rng(3)
    muscles = [random_muscle(rng) for _ in range(12)]
    power = rng.uniform(0.0, 4.5, size=(len(muscles), HOLDS))
    load = rng.choice([0.0, 0.0, 0.05, -0.05], size=(len(muscles), HOLDS))
    # Not a state-space form: the two equations as the paper prints them, all muscles at once.
    psi, eta, rho, mu, mass, gamma = np.array([list(m.as_dict().values()) for m in muscles]).T

    def slope(_, state, p, f):
        phi, x, v = state.reshape(3, -1)
        return np.concatenate([(-eta * phi + p) / psi, v,
                               (-rho * x - mu * v + gamma * phi - f) / mass])

    state = np.zeros(3 * len(muscles))
    history = []
    for k in range(HOLDS):
        # Restarted where the input jumps, so that no step straddles a kink.
        solution = solve_ivp(slope, (k * HOLD_S, (k + 1) * HOLD_S), state, method="DOP853",
                             rtol=1e-11, atol=1e-14, args=(power[:, k], load[:, k]))
        state = solution.y[:, -1]
        history.append(state.reshape(3, -1))
    history = np.array(history)  # [time, quantity, muscle]
    return {"cases": [{
        "parameters": muscle.as_dict(), "hold_s": HOLD_S,
        "power_W": power[i].tolist(), "load_N": load[i].tolist(),
        "temperature_rise_K": history[:, 0, i].tolist(),
        "position_m": history[:, 1, i].tolist(),
        "velocity_m_per_s": history[:, 2, i].tolist(),
    } for i, muscle in enumerate(muscles)]}
