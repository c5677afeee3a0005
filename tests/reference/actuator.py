"""Parameters in their three forms, and the thermal pole from numpy's eigenvalues."""

import numpy as np

from muscle import Muscle, random_muscle


def forms(muscle):
    denominator = muscle.denominator()
    roots = np.roots(denominator)
    real = roots[np.abs(roots.imag) < 1e-9 * np.abs(roots)].real
    monic = denominator / denominator[0]
    return {
        "parameters": muscle.as_dict(),
        # [psi, m eta + mu psi, psi rho + mu eta, eta rho]/gamma
        "theta": [float(c) for c in np.array([muscle.thermal_mass_J_per_K, *denominator[1:]])
                  / muscle.force_per_kelvin_N_per_K],
        "b": [float(monic[3]), float(monic[2]), float(monic[1]),
              float(muscle.force_per_kelvin_N_per_K / denominator[0])],
        "slowest_real_root": float(max(real)),
    }


def cases():
    rng = np.random.default_rng(1)
    muscles = [Muscle()] + [random_muscle(rng) for _ in range(60)]
    return {"cases": [forms(muscle) for muscle in muscles]}
