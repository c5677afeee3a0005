"""Muscles with the effects of docs/muscles.md, each alone and together, under random power.

Smooth effects go to an ODE solver as they stand. Effects with memory (plays, first heating, ageing) are computed along
the temperature on a fine grid, and the mechanics follow in classical Runge-Kutta steps over it.
"""

import numpy as np
from scipy.integrate import solve_ivp

from muscle import Muscle

HOLD_S = 0.5
HOLDS = 30
GRID_S = 1e-4  # of the temperature; the mechanics take steps of two
G = 9.81
OFF = {"convection_ratio": 0.0, "radiation_ratio": 0.0, "heat_transfer_at_K": 60.0, "draught_ratio": 1.0,
       "force_ratio": 1.0, "force_ratio_at_K": 130.0,
       "hysteresis_ratio": 0.0, "hysteresis_range_K": 40.0, "hysteresis_weight": 0.5,
       "softening_ratio": 0.0, "softening_from_K": 20.0, "softening_to_K": 60.0, "hanging_mass_kg": 0.09,
       "creep_ratio": 0.0, "creep_fast_s": 5.0, "creep_slow_s": 60.0,
       "lonely_stroke_m": 0.0, "lonely_stroke_at_K": 60.0,
       "friction_ratio": 0.0, "friction_static_ratio": 1.2, "friction_bristle_m": 20e-6,
       "friction_stribeck_m_per_s": 1e-3, "friction_damping_ratio": 0.2,
       "ageing_ratio": 0.0, "ageing_cycles": 1e4, "ageing_cycle_K": 70.0, "worn_cycles": 0.0,
       "water_ratio": 0.0, "water_force_ratio": 10.0, "drying_K": 80.0, "drying_s": 300.0}
HEAT = {"convection_ratio": 0.7, "radiation_ratio": 0.3}
REAL = {**HEAT, "force_ratio": 6.0, "softening_ratio": 0.4, "hysteresis_ratio": 0.05, "creep_ratio": 0.03,
        "lonely_stroke_m": 0.005}
SMOOTH = {
    "none": {},
    "heat_transfer": HEAT,
    "draught": {**HEAT, "draught_ratio": 2.5},
    "force": {"force_ratio": 6.0},
    "softening": {"softening_ratio": 0.4},
    "softening_wide": {"softening_ratio": 0.185, "softening_from_K": 0.0, "softening_to_K": 130.0,
                       "hanging_mass_kg": 0.03},
    "creep": {"creep_ratio": 0.1},
    "water": {"water_ratio": 0.04, "drying_s": 10.0},
    "smooth_together": {**REAL, "hysteresis_ratio": 0.0, "lonely_stroke_m": 0.0},
    "friction_half_percent": {"friction_ratio": 0.005},
    "friction_two_percent": {"friction_ratio": 0.02},
}
WITH_MEMORY = {
    "hysteresis_5_percent": {"hysteresis_ratio": 0.05},
    "hysteresis_15_percent": {"hysteresis_ratio": 0.15, "hysteresis_weight": 0.7},
    "lonely": {"lonely_stroke_m": 0.005},
    "ageing": {"ageing_ratio": 0.5, "ageing_cycles": 10.0, "worn_cycles": 2.0},
    "real": REAL,
    "real_hard": {**REAL, "hysteresis_ratio": 0.15, "creep_ratio": 0.1},
}
AIR_K = 293.15


def radiation(rise):
    temperature = AIR_K + rise
    return (temperature ** 2 + AIR_K ** 2) * (temperature + AIR_K)


def heat_slope(p, e, phi, power):
    at = e["heat_transfer_at_K"]
    c, r = e["convection_ratio"], e["radiation_ratio"]
    shape = c * (abs(phi) / at) ** 0.25 + r * radiation(phi) / radiation(at) + 1.0 - c - r
    return (power - p.heat_transfer_W_per_K * e["draught_ratio"] * shape * phi) / p.thermal_mass_J_per_K


def water_slope(e, phi, water):
    stays = e["water_ratio"] * np.clip(1.0 - phi / e["drying_K"], 0.0, 1.0)
    return (stays - water) / e["drying_s"]


def stiffness(p, e, phi):
    u = np.clip((phi - e["softening_from_K"]) / (e["softening_to_K"] - e["softening_from_K"]), 0.0, 1.0)
    return p.stiffness_N_per_m * (1.0 - e["softening_ratio"] * u * u * (3.0 - 2.0 * u))


def active_force(p, e, phi):
    per_K = (e["force_ratio"] - 1.0) / e["force_ratio_at_K"]
    return p.force_per_kelvin_N_per_K * phi * (1.0 + per_K * phi / 2.0)


def acceleration(p, e, k, rest, force, x, v, branches, rubs, load):
    stretch = e["hanging_mass_kg"] * G / p.stiffness_N_per_m
    pull = 0.5 * e["creep_ratio"] * p.stiffness_N_per_m * (2.0 * x - branches[0] - branches[1])
    return (force - k * (x - rest - stretch) - p.stiffness_N_per_m * stretch - pull
            - p.damping_Ns_per_m * v - rubs - load) / p.moving_mass_kg


def lugre(p, e, v, z):
    """Friction and the bristle's speed."""
    coulomb = e["friction_ratio"] * e["hanging_mass_kg"] * G
    if coulomb == 0.0:
        return 0.0, 0.0
    sigma0 = coulomb / e["friction_bristle_m"]
    sigma1 = e["friction_damping_ratio"] * np.sqrt(sigma0 * p.moving_mass_kg)
    steady = coulomb * (1.0 + (e["friction_static_ratio"] - 1.0) * np.exp(-(v / e["friction_stribeck_m_per_s"]) ** 2))
    speed = v - sigma0 * abs(v) / steady * z
    return sigma0 * z + sigma1 * speed, speed


def smooth(p, e, power, load):
    """[hold, (temperature, position, velocity)] at the end of each hold."""
    def slope(_, state, watts, newtons):
        phi, x, v, fast, slow, water, z = state
        rubs, bristle = lugre(p, e, v, z)
        force = active_force(p, e, phi) * (1.0 + e["water_force_ratio"] * water)
        return [heat_slope(p, e, phi, watts), v,
                acceleration(p, e, stiffness(p, e, phi), 0.0, force, x, v, (fast, slow), rubs, newtons),
                (x - fast) / e["creep_fast_s"], (x - slow) / e["creep_slow_s"], water_slope(e, phi, water), bristle]

    state = np.array([0.0, 0.0, 0.0, 0.0, 0.0, e["water_ratio"], 0.0])
    ends = []
    for k in range(HOLDS):
        state = solve_ivp(slope, (0.0, HOLD_S), state, method="DOP853", rtol=1e-10, atol=1e-13,
                          args=(power[k], load[k])).y[:, -1]
        ends.append(state[:3])
    return np.array(ends)


def effective(e, phi):
    """Plays along the temperature."""
    radii = e["hysteresis_ratio"] * e["hysteresis_range_K"] / (1.2 * e["hysteresis_weight"]) * np.arange(1, 6) / 5.0
    plays = np.zeros((len(phi), 5))
    for j, radius in enumerate(radii):
        at = 0.0
        for i, now in enumerate(phi.tolist()):
            at = max(now - radius, min(now + radius, at))
            plays[i, j] = at
    w = e["hysteresis_weight"]
    return (1.0 - w) * phi + w * plays.mean(axis=1)


def with_memory(p, e, power, load):
    per_hold = round(HOLD_S / GRID_S)
    times = np.arange(1, per_hold + 1) * GRID_S
    phi = [np.zeros(1)]
    for k in range(HOLDS):
        phi.append(solve_ivp(lambda _, s: [heat_slope(p, e, s[0], power[k])], (0.0, HOLD_S), phi[-1][-1:],
                             method="DOP853", rtol=1e-11, atol=1e-13, t_eval=times).y[0])
    phi = np.concatenate(phi)
    path = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(phi)))])
    cycles = e["worn_cycles"] + path / (2.0 * e["ageing_cycle_K"])
    force = active_force(p, e, effective(e, phi)) * (1.0 - e["ageing_ratio"] * cycles / e["ageing_cycles"])
    rest = -e["lonely_stroke_m"] * np.minimum(1.0, np.maximum.accumulate(phi) / e["lonely_stroke_at_K"])
    k = stiffness(p, e, phi)

    def slope(i, newtons, x, v, fast, slow):
        return (v, acceleration(p, e, k[i], rest[i], force[i], x, v, (fast, slow), 0.0, newtons),
                (x - fast) / e["creep_fast_s"], (x - slow) / e["creep_slow_s"])

    force, rest, k = force.tolist(), rest.tolist(), k.tolist()
    h = 2.0 * GRID_S
    state = (0.0, 0.0, 0.0, 0.0)
    ends = []
    for hold in range(HOLDS):
        for i in range(hold * per_hold, (hold + 1) * per_hold, 2):
            k1 = slope(i, load[hold], *state)
            k2 = slope(i + 1, load[hold], *(s + h / 2 * d for s, d in zip(state, k1)))
            k3 = slope(i + 1, load[hold], *(s + h / 2 * d for s, d in zip(state, k2)))
            k4 = slope(i + 2, load[hold], *(s + h * d for s, d in zip(state, k3)))
            state = tuple(s + h / 6 * (a + 2 * (b + c) + d) for s, a, b, c, d in zip(state, k1, k2, k3, k4))
        ends.append([phi[(hold + 1) * per_hold], state[0], state[1]])
    return np.array(ends)


def cases():
    rng = np.random.default_rng(18)
    result = []
    for kind, compute, effects in [("smooth", smooth, SMOOTH), ("memory", with_memory, WITH_MEMORY)]:
        for name, changed in effects.items():
            # High and low, so that hysteresis loops are wide and the first heating lasts for a while.
            power = np.where(rng.uniform(size=HOLDS) < 0.5, rng.uniform(3.0, 4.5, HOLDS), rng.uniform(0.0, 1.5, HOLDS))
            load = rng.choice([0.0, 0.0, 0.05, -0.05], size=HOLDS)
            muscle = Muscle()
            ends = compute(muscle, {**OFF, **changed}, power.tolist(), load.tolist())
            result.append({"name": name, "kind": kind, "parameters": muscle.as_dict(), "effects": changed,
                           "hold_s": HOLD_S, "power_W": power.tolist(), "load_N": load.tolist(),
                           "temperature_rise_K": ends[:, 0].tolist(), "position_m": ends[:, 1].tolist(),
                           "velocity_m_per_s": ends[:, 2].tolist()})
    return {"cases": result}
