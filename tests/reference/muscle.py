"""The muscle of Eqs. (1) and (2): psi phi' = -eta phi + P, m x'' = -rho x - mu x' + gamma phi."""

import dataclasses

import numpy as np


@dataclasses.dataclass(frozen=True)
class Muscle:
    """The defaults are the paper's actuator."""

    thermal_mass_J_per_K: float = 0.162
    heat_transfer_W_per_K: float = 0.089
    stiffness_N_per_m: float = 16.0
    damping_Ns_per_m: float = 2.0
    moving_mass_kg: float = 0.09
    force_per_kelvin_N_per_K: float = 0.0086

    @property
    def dc_gain_m_per_W(self):
        return self.force_per_kelvin_N_per_K / (self.heat_transfer_W_per_K * self.stiffness_N_per_m)

    def denominator(self):
        """(psi s + eta)(m s^2 + mu s + rho), descending."""
        mechanics = [self.moving_mass_kg, self.damping_Ns_per_m, self.stiffness_N_per_m]
        return np.polymul([self.thermal_mass_J_per_K, self.heat_transfer_W_per_K], mechanics)

    def state_space(self):
        """States [temperature rise, position, velocity], inputs [power, load]."""
        mass = self.moving_mass_kg
        a = np.array([
            [-self.heat_transfer_W_per_K / self.thermal_mass_J_per_K, 0.0, 0.0],
            [0.0, 0.0, 1.0],
            [self.force_per_kelvin_N_per_K / mass, -self.stiffness_N_per_m / mass,
             -self.damping_Ns_per_m / mass],
        ])
        b = np.array([[1.0 / self.thermal_mass_J_per_K, 0.0], [0.0, 0.0], [0.0, -1.0 / mass]])
        return a, b

    def as_dict(self):
        return dataclasses.asdict(self)


def random_muscle(rng, damping_ratio=None):
    """A muscle within a factor of 4 of the paper's, with mechanics faster than its cooling.

    damping_ratio: of the mechanics; drawn from 0.2 to 3 when not given.
    """
    def near(value):
        return float(value * 4.0 ** rng.uniform(-0.5, 0.5))

    while True:
        zeta = damping_ratio or 10.0 ** rng.uniform(np.log10(0.2), np.log10(3.0))
        mass, stiffness = near(0.09), near(16.0)
        result = Muscle(thermal_mass_J_per_K=near(0.162), heat_transfer_W_per_K=near(0.089),
                        stiffness_N_per_m=stiffness,
                        damping_Ns_per_m=float(2.0 * zeta * np.sqrt(mass * stiffness)),
                        moving_mass_kg=mass, force_per_kelvin_N_per_K=near(0.0086))
        mechanics = np.roots([mass, result.damping_Ns_per_m, stiffness])
        cooling = result.heat_transfer_W_per_K / result.thermal_mass_J_per_K
        if min(-mechanics.real) > 1.5 * cooling:
            return result
