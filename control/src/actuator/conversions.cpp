#include "supercoil/control/actuator/conversions.hpp"

#include <cmath>

#include "supercoil/control/linear/polynomial.hpp"

namespace supercoil::control {

Theta theta_from(const PhysicalParameters& p) {
  const double psi = p.thermal_mass_J_per_K;
  const double eta = p.heat_transfer_W_per_K;
  const double rho = p.stiffness_N_per_m;
  const double mu = p.damping_Ns_per_m;
  return Theta{psi, p.moving_mass_kg * eta + mu * psi, psi * rho + mu * eta, eta * rho} /
         p.force_per_kelvin_N_per_K;
}

TransferFunction transfer_function_from(const PhysicalParameters& p) {
  return transfer_function_from(theta_from(p), p.moving_mass_kg).value();
}

std::optional<TransferFunction> transfer_function_from(const Theta& theta, double moving_mass_kg) {
  if (!(theta[0] > 0.0 && moving_mass_kg > 0.0)) return std::nullopt;
  const double scale = 1.0 / (theta[0] * moving_mass_kg);
  return TransferFunction{theta[3] * scale, theta[2] * scale, theta[1] * scale, scale};
}

std::optional<double> slowest_real_root(double c3, double c2, double c1, double c0) {
  if (!is_hurwitz<3>({c0, c1, c2, c3})) return std::nullopt;
  const auto value = [&](double s) { return ((c3 * s + c2) * s + c1) * s + c0; };
  const auto slope = [&](double s) { return (3.0 * c3 * s + 2.0 * c2) * s + c1; };
  // Hurwitz means c1 c2 > c0 c3: the polynomial is positive at 0 and negative at −c2/c3. Newton
  // from 0 meets the slowest root first; a step that leaves the bracket is halved instead.
  double low = -c2 / c3;
  double high = 0.0;
  double root = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double at_root = value(root);
    (at_root > 0.0 ? high : low) = root;
    double next = root - at_root / slope(root);
    if (std::abs(next - root) <= 1e-15 * std::abs(root)) return root;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    root = next;
  }
  return root;
}

std::optional<PhysicalParameters> physical_from(const Theta& theta, const KnownParameters& known) {
  const double mass = known.moving_mass_kg;
  const auto pole = slowest_real_root(theta[0] * mass, theta[1], theta[2], theta[3]);
  if (!pole) return std::nullopt;
  PhysicalParameters p;
  p.force_per_kelvin_N_per_K = known.force_per_kelvin_N_per_K;
  p.moving_mass_kg = mass;
  p.thermal_mass_J_per_K = known.force_per_kelvin_N_per_K * theta[0];
  p.heat_transfer_W_per_K = -*pole * p.thermal_mass_J_per_K;
  p.damping_Ns_per_m =
      (known.force_per_kelvin_N_per_K * theta[1] - mass * p.heat_transfer_W_per_K) /
      p.thermal_mass_J_per_K;
  p.stiffness_N_per_m = known.force_per_kelvin_N_per_K * theta[3] / p.heat_transfer_W_per_K;
  if (check(p)) return std::nullopt;
  return p;
}

std::optional<PhysicalParameters> physical_from(const TransferFunction& function,
                                                const KnownParameters& known) {
  if (!(function.b3 > 0.0)) return std::nullopt;
  const double mass = known.moving_mass_kg;
  const double theta1 = 1.0 / (mass * function.b3);
  const Theta theta =
      Theta{1.0, mass * function.b2, mass * function.b1, mass * function.b0} * theta1;
  return physical_from(theta, known);
}

}  // namespace supercoil::control
