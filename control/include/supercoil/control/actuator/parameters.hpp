// The muscle's parameters in the three forms that the literature uses.
#pragma once

#include <array>
#include <optional>

#include "supercoil/control/scalar/fixed_point_fit.hpp"
#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// A super-coiled polymer muscle with its load, lumped (paper, Eqs. (1) and (2), Table 1).
/// The defaults are the paper's actuator (Sec. 5.1).
struct PhysicalParameters {
  double thermal_mass_J_per_K = 0.162;       ///< ψ
  double heat_transfer_W_per_K = 0.089;      ///< η
  double stiffness_N_per_m = 16.0;           ///< ϱ
  double damping_Ns_per_m = 2.0;             ///< µ
  double moving_mass_kg = 0.09;              ///< m̂, the muscle's own mass and its load's
  double force_per_kelvin_N_per_K = 0.0086;  ///< γ

  friend bool operator==(const PhysicalParameters&, const PhysicalParameters&) = default;

  /// x/P at rest, γ/(ηϱ), in m/W.
  double dc_gain_m_per_W() const {
    return force_per_kelvin_N_per_K / (heat_transfer_W_per_K * stiffness_N_per_m);
  }
  /// −η/ψ, the thermal pole, in rad/s.
  double thermal_pole_rad_per_s() const { return -heat_transfer_W_per_K / thermal_mass_J_per_K; }
};

/// θ = [ψ, m̂η+µψ, ψϱ+µη, ηϱ]/γ: the coefficients that are linear in the measured signals,
/// z = P/Λ = θᵀφ with φ = [m̂s³X, s²X, sX, X]/Λ (paper, Eq. (3), as corrected in docs/paper.md).
using Theta = Vector<double, 4>;

/// x/P = b3/(s³ + b2 s² + b1 s + b0) (paper, Eq. (5)).
struct TransferFunction {
  double b0;
  double b1;
  double b2;
  double b3;
};

/// The allowed range of a parameter: holds any muscle of thread, from a hair's size to a rope's.
struct PhysicalRange {
  const char* name;  ///< as in the code and in configurations
  double PhysicalParameters::*member;
  double min;
  double max;
};
inline constexpr std::array<PhysicalRange, 6> physical_ranges{{
    {"thermal_mass_J_per_K", &PhysicalParameters::thermal_mass_J_per_K, 1e-4, 1e3},
    {"heat_transfer_W_per_K", &PhysicalParameters::heat_transfer_W_per_K, 1e-5, 1e3},
    {"stiffness_N_per_m", &PhysicalParameters::stiffness_N_per_m, 1e-2, 1e6},
    {"damping_Ns_per_m", &PhysicalParameters::damping_Ns_per_m, 1e-4, 1e5},
    {"moving_mass_kg", &PhysicalParameters::moving_mass_kg, 1e-5, 1e3},
    {"force_per_kelvin_N_per_K", &PhysicalParameters::force_per_kelvin_N_per_K, 1e-6, 1e3},
}};

/// The first parameter that is NaN or outside its range.
std::optional<Violation> check(const PhysicalParameters& parameters);

}  // namespace supercoil::control
