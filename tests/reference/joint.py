"""Joints with two muscles, or with one against a spring, under random powers and loads.

The muscles' own equations are those of muscle_effects.py; the smooth ones go to an ODE solver as they stand.
"""

import dataclasses

import numpy as np
from scipy.integrate import solve_ivp

from muscle import Muscle
from muscle_effects import G, OFF, REAL, acceleration, active_force, heat_slope, lugre, stiffness

HOLD_S = 0.5
HOLDS = 30
SMOOTH = {**REAL, "hysteresis_ratio": 0.0, "lonely_stroke_m": 0.0}
STRONGER = Muscle(thermal_mass_J_per_K=0.2, heat_transfer_W_per_K=0.11, stiffness_N_per_m=22.0, damping_Ns_per_m=1.5,
                  force_per_kelvin_N_per_K=0.01)


@dataclasses.dataclass(frozen=True)
class Joint:
    lever_m: float = 0.015  # at angle 0
    table_m: tuple = ()  # of levers, evenly spaced over table_rad; empty: constant
    table_rad: tuple = (-0.8, 0.7)
    inertia_kg_m2: float = 2e-5
    damping_Nms_per_rad: float = 0.0
    spring_Nm_per_rad: float = 0.0
    pretension_N: float = 0.883
    friction_ratio: float = 0.0
    weight_Nm: float = 0.0
    antagonist_lever_ratio: float = 1.0

    @property
    def directions(self):
        """Directions of each muscle's contraction and pull along the agonist's arc."""
        return 1.0, -self.antagonist_lever_ratio

    def radius(self, angle):
        return np.interp(angle, np.linspace(*self.table_rad, len(self.table_m)), self.table_m) if self.table_m else self.lever_m

    def contraction(self, angle):
        """The lever's integral from angle 0, exact by trapezoids from kink to kink."""
        if not self.table_m:
            return self.lever_m * angle
        kinks = [at for at in np.linspace(*self.table_rad, len(self.table_m)) if min(0.0, angle) < at < max(0.0, angle)]
        at = np.array(sorted([0.0, *kinks, angle], reverse=bool(angle < 0.0)))
        radii = np.array([self.radius(a) for a in at])
        return float(np.sum(0.5 * (radii[1:] + radii[:-1]) * np.diff(at)))


PAIR = (Muscle(), Muscle())
CASES = {  # joint, muscles, effects, load in Nm
    "linear": (Joint(), PAIR, {}, 0.0),
    "unequal": (Joint(lever_m=0.02, inertia_kg_m2=6e-5), (Muscle(), STRONGER), {}, 0.0),
    "damper_and_spring": (Joint(damping_Nms_per_rad=3e-4, spring_Nm_per_rad=2e-3), PAIR, {}, 0.0),
    "smooth_effects": (Joint(), PAIR, SMOOTH, 0.0),
    "weight": (Joint(weight_Nm=0.003), PAIR, {}, 0.0),
    "hard_weight": (Joint(weight_Nm=0.012), PAIR, SMOOTH, 0.0),
    "spring_alone": (Joint(spring_Nm_per_rad=4e-3), (Muscle(),), SMOOTH, 0.0),
    "load": (Joint(), PAIR, SMOOTH, 0.002),
    "friction": (Joint(friction_ratio=0.02), PAIR, {}, 0.0),
    "slack": (Joint(pretension_N=0.05), PAIR, {}, 0.006),
    "slack_friction": (Joint(pretension_N=0.05, friction_ratio=0.2), PAIR, {}, 0.007),
    "lever_table": (Joint(table_m=(0.010, 0.014, 0.016, 0.015, 0.011), lever_m=0.016 - 0.001 * 2.0 / 15.0),
                    (Muscle(), STRONGER), SMOOTH, 0.004),
    "levers_of_their_own": (Joint(antagonist_lever_ratio=0.6, weight_Nm=0.002), (Muscle(), STRONGER), SMOOTH, 0.003),
    "lever_tables_of_their_own": (Joint(table_m=(0.010, 0.014, 0.016, 0.015, 0.011), lever_m=0.016 - 0.001 * 2.0 / 15.0,
                                        antagonist_lever_ratio=1.4), (STRONGER, Muscle()), SMOOTH, 0.004),
}


def pulled(joint, effects):
    """Each muscle's effects with its pretension: at angle 0 the moments are equal."""
    pretensions = [joint.pretension_N / abs(direction) for direction in joint.directions]
    return [({**OFF, **effects, "hanging_mass_kg": pretension / G}, pretension) for pretension in pretensions]


def tensions(joint, muscles, effects, x, rises, branches):
    """Tensions before they are cut off at zero: the mass times the acceleration without damper is the muscle's pull."""
    found = []
    for p, direction, phi, pair, (own, pretension) in zip(muscles, joint.directions, rises, branches, pulled(joint, effects)):
        found.append(p.moving_mass_kg * acceleration(p, own, stiffness(p, own, phi), 0.0, active_force(p, own, phi),
                                                     direction * x, 0.0, pair, 0.0, -pretension))
    return found


def split(state):
    """Rises, position, velocity, bristle, and the two creeping branches of each muscle."""
    return state[:2], state[2], state[3], state[4], (state[5:7], state[7:9])


def run(joint, muscles, effects, power, load):
    """The joint's path: its state at the end of each hold."""
    rubbing = {**OFF, "friction_ratio": joint.friction_ratio, "hanging_mass_kg": joint.pretension_N / G}
    mass = joint.inertia_kg_m2 / joint.lever_m ** 2
    lump = Muscle(moving_mass_kg=mass)
    alone = len(muscles) == 1

    def slope(_, state, watts, newton_metres):
        rises, x, v, z, branches = split(state)
        gain, arc = joint.radius(x / joint.lever_m) / joint.lever_m, joint.contraction(x / joint.lever_m)
        force = -newton_metres / joint.lever_m - joint.weight_Nm / joint.lever_m * np.sin(x / joint.lever_m)
        force -= (joint.damping_Nms_per_rad * v + joint.spring_Nm_per_rad * x) / joint.lever_m ** 2
        if alone:
            force -= joint.pretension_N
        for p, direction, tension in zip(muscles, joint.directions, tensions(joint, muscles, effects, arc, rises, branches)):
            if tension > 0.0:
                force += gain * direction * (tension - p.damping_Ns_per_m * gain * direction * v)
        rubs, bristle = lugre(lump, rubbing, v, z)
        heating = [heat_slope(p, {**OFF, **effects}, phi, w) for p, phi, w in zip(muscles, rises, watts)]
        creeping = [(direction * arc - at) / {**OFF, **effects}[time] for direction, pair in zip(joint.directions, branches)
                    for at, time in zip(pair, ("creep_fast_s", "creep_slow_s"))]
        return [*heating, *[0.0] * alone, v, (force - rubs) / mass, bristle, *creeping]

    state = np.zeros(9)
    ends = []
    for hold in range(HOLDS):
        state = solve_ivp(slope, (0.0, HOLD_S), state, method="DOP853", rtol=1e-10, atol=1e-13,
                          args=(power[hold], load[hold])).y[:, -1]
        rises, x, v, _, branches = split(state)
        pulls = np.maximum(0.0, tensions(joint, muscles, effects, joint.contraction(x / joint.lever_m), rises, branches))
        ends.append([x / joint.lever_m, v / joint.lever_m, *rises, *pulls, *[0.0] * alone])
    return np.array(ends)


def cases():
    rng = np.random.default_rng(27)
    result = []
    for name, (joint, muscles, effects, load_Nm) in CASES.items():
        high = rng.uniform(size=(HOLDS, 2)) < 0.5
        power = np.where(high, rng.uniform(3.0, 4.5, (HOLDS, 2)), rng.uniform(0.0, 1.5, (HOLDS, 2)))
        load = load_Nm * rng.choice([0.0, 1.0, -1.0], size=HOLDS)
        ends = run(joint, muscles, effects, power, load.tolist())
        result.append({"name": name, "joint": dataclasses.asdict(joint), "effects": effects,
                       "muscles": [muscle.as_dict() for muscle in muscles], "hold_s": HOLD_S,
                       "power_W": power.tolist(), "load_Nm": load.tolist(),
                       "angle_rad": ends[:, 0].tolist(), "velocity_rad_per_s": ends[:, 1].tolist(),
                       "temperature_rise_K": ends[:, 2:4].tolist(), "tension_N": ends[:, 4:].tolist()})
    return {"cases": result}
