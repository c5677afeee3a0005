"""PI and PD with feedforward in closed loop, and the motion of the reference models."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import BPoly
from scipy.signal import TransferFunction, step

import mrac_ode
from muscle import Muscle

TIMES = np.arange(0.5, 20.5, 0.5)


def closed_loop(law, extra):
    """Position for a step of 10 mm. law(model, x, extra) gives the power and the slopes of extra."""
    muscle = Muscle()
    a, b = muscle.state_space()
    denominator, gain = mrac_ode.MODELS["design"]
    low = np.array(denominator[:0:-1])

    def slope(t, state):
        plant, model, more = state[:3], state[3:6], state[6:]
        power, more_slopes = law(gain * model, plant[1], more)
        return np.concatenate([a @ plant + b[:, 0] * power,
                               [model[1], model[2], 0.010 - low @ model], more_slopes])

    solution = solve_ivp(slope, (0.0, TIMES[-1]), np.zeros(6 + extra), method="LSODA", rtol=1e-10,
                         atol=1e-14, t_eval=TIMES)
    return {"time_s": TIMES.tolist(), "position_m": solution.y[1].tolist(),
            "model_m": (gain * solution.y[3]).tolist()}


def pi_law(model, x, more):
    error = model[0] - x
    return 2000.0 * error + 1100.0 * more[0], [error]


def pd_law(model, x, more):
    """more: x through 1/(s/60 + 1)^2 and its derivative."""
    power = 2000.0 * (model[0] - x) + 300.0 * (model[1] - more[1]) + 165.58 * model[0]
    return power, [more[1], 3600.0 * (x - more[0]) - 120.0 * more[1]]


def model_case(name):
    denominator, gain = mrac_ode.MODELS[name]
    times, response = step(TransferFunction([gain], denominator), T=np.linspace(0.0, 100.0, 100001))
    return {"name": name, "dc_gain": gain / denominator[-1],
            "overshoot": float(np.max(response) - 1.0),
            "time_s": times[1000:20001:1000].tolist(),
            "response": response[1000:20001:1000].tolist()}


def trajectory():
    """Unevenly spaced knots on two sines; each piece matches position and two derivatives of both neighbours."""
    rng = np.random.default_rng(5)
    times = np.concatenate([[0.0], np.cumsum(rng.uniform(0.02, 0.4, 30))])
    positions = 0.004 * (1.0 - np.cos(1.7 * times)) + 0.001 * (1.0 - np.cos(5.3 * times))
    velocities = 0.0068 * np.sin(1.7 * times) + 0.0053 * np.sin(5.3 * times)
    velocities[-1] = 0.0
    accelerations = np.zeros_like(times)
    accelerations[1:-1] = (velocities[2:] - velocities[:-2]) / (times[2:] - times[:-2])
    way = BPoly.from_derivatives(times, np.stack([positions, velocities, accelerations], axis=1))
    at = np.linspace(0.0, times[-1], 1001)[:-1]
    return {"knots": np.stack([times, positions, velocities], axis=1).tolist(), "time_s": at.tolist(),
            **{name: way(at, nu).tolist() for nu, name in enumerate(["position", "velocity", "acceleration", "jerk"])}}


def cases():
    return {"pi": closed_loop(pi_law, 1), "pd_ff": closed_loop(pd_law, 2),
            "models": [model_case(name) for name in mrac_ode.MODELS], "trajectory": trajectory()}
