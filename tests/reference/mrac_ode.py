"""The paper's MRAC, Eqs. (9)-(17) as corrected, as one continuous-time differential equation.

Written from the equations in docs, independent of the C++ library; scipy integrates it. Position
and reference are in watts at rest (metres over the muscle's DC gain).

As a program it simulates the physical muscle for 200 s and prints how long that took:
    python mrac_ode.py --design a --duration 200
"""

import argparse
import dataclasses
import time

import numpy as np
from scipy.integrate import solve_ivp

from muscle import Muscle

# A third-order model Wm = gain/denominator, denominator monic and descending.
MODELS = {
    "eq8": ([1.0, 1.0, 1.38, 1.0], 1.0),
    "design": ([1.0, 2.18, 2.104, 0.8], 0.8),
    "wm16": (np.poly([-4.0, -5.0, -0.8]).tolist(), 16.0),
}


@dataclasses.dataclass
class Design:
    """The constants; the defaults are those of the paper."""

    alpha: tuple = (1.0, 1.0)  # alpha(s) = [alpha0 s, alpha1]
    lambda_: tuple = (1.0, 3.0, 2.0)  # descending
    p0: float = 4.0
    p1: float = 5.0
    q0: float = 0.8
    gain: tuple = (6.0, 6.0, 6.0, 7.0, 2.0, 3.0)  # the diagonal of Pi
    nu: float = 4.0
    alpha0: float = 3.0
    initial: tuple = (0.0,) * 6
    model: str = "wm16"
    freeze: bool = False  # theta and sigma are held while the power is limited
    limits: tuple = (-np.inf, np.inf)


def design(name, factor=1.0):
    if name == "printed":
        base = Design()
    elif name == "a":
        base, factor = Design(alpha=(20.0, 400.0), lambda_=(1.0, 40.0, 400.0), alpha0=1.0,
                              initial=(0.0,) * 5 + (0.3,)), 20.0
    else:
        raise ValueError(name)
    return dataclasses.replace(base, gain=tuple(factor * g for g in base.gain),
                               nu=factor * base.nu)


def sine(muscle):
    """Sec. 5.2's reference at the physical scale: 11 + 9 sin(0.25 t) mm."""
    return lambda t: (0.011 + 0.009 * np.sin(0.25 * t)) / muscle.dc_gain_m_per_W


class ClosedLoop:
    """Muscle, reference model and controller. `parts` divides the state."""

    sizes = {"muscle": 3, "model": 3, "power": 2, "position": 2, "phi1": 6, "phi": 6, "theta": 6,
             "sigma": 1, "r0": 1, "e1": 1}

    def __init__(self, constants, muscle, reference):
        self.c, self.reference = constants, reference
        self.a, self.b = muscle.state_space()
        self.per_metre = 1.0 / muscle.dc_gain_m_per_W
        self.pi = np.array(constants.gain)
        denominator, self.model_gain = MODELS[constants.model]
        self.model_low = np.array(denominator[:0:-1])  # ascending, without the leading 1
        self.lambda_low = np.array(constants.lambda_[:0:-1])
        ends = np.cumsum(list(self.sizes.values()))
        self.cut = {name: slice(end - size, end)
                    for (name, size), end in zip(self.sizes.items(), ends)}
        self.size = ends[-1]

    def start(self):
        state = np.zeros(self.size)
        state[self.cut["theta"]] = self.c.initial
        return state

    def power(self, t, state):
        """Demanded and applied power, theta' and whatever else the slopes need."""
        c, part = self.c, lambda name: state[self.cut[name]]
        y = part("muscle")[1] * self.per_metre
        u_filtered, y_filtered = part("power"), part("position")
        omega = np.array([c.alpha[0] * u_filtered[1], c.alpha[1] * u_filtered[0],
                          c.alpha[0] * y_filtered[1], c.alpha[1] * y_filtered[0],
                          y, self.reference(t)])
        phi1, phi, r0 = part("phi1"), part("phi"), state[self.cut["r0"]][0]
        epsilon = y - self.model_gain * part("model")[0] - state[self.cut["e1"]][0]
        weighted = self.pi * phi
        q, q_slope = phi @ weighted, weighted @ (phi1 - c.p0 * phi)
        theta_slope = -weighted * epsilon
        wanted = (part("theta") @ omega + theta_slope @ phi1
                  - c.alpha0 * (c.p1 - c.p0) * q**2 * r0 - 4.0 * c.alpha0 * q * q_slope * r0
                  + c.alpha0**2 * q**4 * r0 - c.alpha0 * q**3 * epsilon)
        applied = min(max(wanted, c.limits[0]), c.limits[1])
        return wanted, applied, theta_slope, epsilon, q, omega, y

    def slope(self, t, state):
        c, cut = self.c, self.cut
        wanted, applied, theta_slope, epsilon, q, omega, y = self.power(t, state)
        rests = c.freeze and wanted != applied
        result = np.empty(self.size)
        result[cut["muscle"]] = self.a @ state[cut["muscle"]] + self.b[:, 0] * applied
        for name, low, drive in (("model", self.model_low, self.reference(t)),
                                 ("power", self.lambda_low, applied),
                                 ("position", self.lambda_low, y)):
            x = state[cut[name]]
            result[cut[name]] = [*x[1:], drive - low @ x]
        result[cut["phi1"]] = omega - c.p1 * state[cut["phi1"]]
        result[cut["phi"]] = state[cut["phi1"]] - c.p0 * state[cut["phi"]]
        r0, sigma = state[cut["r0"]], state[cut["sigma"]]
        result[cut["theta"]] = 0.0 if rests else theta_slope
        result[cut["sigma"]] = 0.0 if rests else c.nu * epsilon * r0
        result[cut["r0"]] = -c.p0 * r0 - c.alpha0 * r0 * q**2 + q * epsilon
        result[cut["e1"]] = -c.q0 * state[cut["e1"]] + sigma * r0
        return result


def simulate(constants, muscle, reference, times, method="LSODA", rtol=1e-9, atol=1e-12):
    """Positions, model positions (W at rest), theta at the times, which start after 0."""
    loop = ClosedLoop(constants, muscle, reference)
    solution = solve_ivp(loop.slope, (0.0, times[-1]), loop.start(), method=method, rtol=rtol,
                         atol=atol, t_eval=times)
    if not solution.success:
        raise RuntimeError(solution.message)
    return {"position_W": solution.y[loop.cut["muscle"]][1] * loop.per_metre,
            "model_W": solution.y[loop.cut["model"]][0] * loop.model_gain,
            "theta": solution.y[loop.cut["theta"]].T}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--design", choices=("printed", "a"), default="printed")
    parser.add_argument("--factor", type=float, default=10.0, help="on the printed Pi and nu")
    parser.add_argument("--duration", type=float, default=200.0, help="s")
    parser.add_argument("--method", default="LSODA")
    parser.add_argument("--rtol", type=float, default=1e-6)
    arguments = parser.parse_args()
    muscle = Muscle()
    constants = dataclasses.replace(design(arguments.design, arguments.factor), limits=(0.0, 4.5))
    times = np.linspace(0.0, arguments.duration, int(arguments.duration * 10) + 1)
    begin = time.perf_counter()
    result = simulate(constants, muscle, sine(muscle), times, arguments.method, arguments.rtol,
                      atol=1e-3 * arguments.rtol)
    wall_s = time.perf_counter() - begin
    late = times > 0.8 * arguments.duration
    error_W = np.sqrt(np.mean((result["position_W"] - result["model_W"])[late] ** 2))
    print(f"simulated_s={arguments.duration} wall_s={wall_s:.3f} "
          f"realtime_factor={arguments.duration / wall_s:.1f} "
          f"late_rms_um={1e6 * error_W * muscle.dc_gain_m_per_W:.2f}")


if __name__ == "__main__":
    main()
