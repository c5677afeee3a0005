// Physical parameters ↔ θ ↔ transfer function, both ways.
#pragma once

#include <optional>

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::control {

/// θ from the physical parameters (any valid set).
Theta theta_from(const PhysicalParameters& parameters);

/// b0…b3 from the physical parameters (any valid set).
TransferFunction transfer_function_from(const PhysicalParameters& parameters);

/// Not contained in θ: force per kelvin γ in N/K and moving mass m̂ in kg.
struct KnownParameters {
  double force_per_kelvin_N_per_K;
  double moving_mass_kg;
};

/// Physical parameters from θ. The thermal pole is the slowest real root of
/// θ1 m̂s³ + θ2 s² + θ3 s + θ4, which is right for any muscle whose mechanics are faster than its
/// cooling. Empty when that polynomial is not Hurwitz or a resulting parameter is not positive.
std::optional<PhysicalParameters> physical_from(const Theta& theta, const KnownParameters& known);

/// The same from b0…b3; empty also when b3 is not positive.
std::optional<PhysicalParameters> physical_from(const TransferFunction& function,
                                                const KnownParameters& known);

/// The transfer function of θ; empty when θ1 or m̂ is not positive.
std::optional<TransferFunction> transfer_function_from(const Theta& theta, double moving_mass_kg);

/// The slowest real root of c3 s³ + c2 s² + c1 s + c0 in rad/s; empty when it is not Hurwitz.
std::optional<double> slowest_real_root(double c3, double c2, double c1, double c0);

}  // namespace supercoil::control
