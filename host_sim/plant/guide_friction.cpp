#include "plant/guide_friction.hpp"

#include <algorithm>
#include <cmath>

#include "plant/softening.hpp"

namespace supercoil::host_sim {

namespace {

/// A step is divided into parts in which a bristle relaxes by at most this fraction: the
/// fourth-order rule is stable below 2.8.
constexpr double max_relaxation = 0.5;
constexpr int max_parts = 200;

}  // namespace

void GuideFriction::set(const control::PhysicalParameters& parameters,
                        const PlantEffects& effects) {
  per_mass_ = 1.0 / parameters.moving_mass_kg;
  viscous_Ns_per_m_ = parameters.damping_Ns_per_m;
  coulomb_N_ = effects.friction_ratio * effects.hanging_mass_kg * gravity_m_per_s2;
  static_N_ = effects.friction_static_ratio * coulomb_N_;
  stiffness_N_per_m_ = coulomb_N_ / effects.friction_bristle_m;
  damping_Ns_per_m_ =
      effects.friction_damping_ratio * std::sqrt(stiffness_N_per_m_ * parameters.moving_mass_kg);
  per_stribeck_ = 1.0 / effects.friction_stribeck_m_per_s;
  if (!on()) bristle_m_ = 0.0;
}

double GuideFriction::bristle_speed(double bristle_m, double velocity_m_per_s) const {
  if (!on()) return 0.0;
  const double u = velocity_m_per_s * per_stribeck_;
  const double steady_N = coulomb_N_ + (static_N_ - coulomb_N_) * std::exp(-u * u);
  return velocity_m_per_s - std::abs(velocity_m_per_s) * bristle_m * stiffness_N_per_m_ / steady_N;
}

GuideFriction::State GuideFriction::slope(const State& s, double stiffness_N_per_m,
                                          double force_N) const {
  const double speed = bristle_speed(s.bristle_m, s.velocity_m_per_s);
  const double friction_N = stiffness_N_per_m_ * s.bristle_m + damping_Ns_per_m_ * speed;
  return {s.velocity_m_per_s,
          per_mass_ * (force_N - stiffness_N_per_m * s.position_m -
                       viscous_Ns_per_m_ * s.velocity_m_per_s - friction_N),
          speed};
}

Motion GuideFriction::coarse_step(const Motion& from, const Drive& drive,
                                  const Mechanics& mechanics) {
  const double rubs_N = stiffness_N_per_m_ * bristle_m_;
  Drive rubbed = drive;
  rubbed.force_N -= rubs_N;
  rubbed.force_end_N -= rubs_N;
  const Motion to = mechanics.step(from, rubbed);
  const double path_m = to.position_m - from.position_m;
  const double max_m = coulomb_N_ / stiffness_N_per_m_;
  const double steady_m = std::copysign(max_m, path_m);
  bristle_m_ = steady_m + (bristle_m_ - steady_m) * std::exp(-std::abs(path_m) / max_m);
  return to;
}

Motion GuideFriction::step(const Motion& from, const Drive& drive, const Mechanics& mechanics) {
  const double step_s = mechanics.step_s();
  const double relaxation = std::abs(from.velocity_m_per_s) * stiffness_N_per_m_ / coulomb_N_;
  const double springs = std::sqrt((stiffness_N_per_m_ + drive.stiffness_N_per_m) * per_mass_) +
                         (viscous_Ns_per_m_ + damping_Ns_per_m_) * per_mass_;
  const double needed = std::ceil(step_s * (relaxation + springs) / max_relaxation);
  if (!(needed <= max_parts)) return coarse_step(from, drive, mechanics);
  const int parts = std::max(1, static_cast<int>(needed));
  const double h = step_s / parts;
  State s{from.position_m, from.velocity_m_per_s, bristle_m_};
  const auto advanced = [&s](const State& slope, double by) {
    return State{s.position_m + by * slope.position_m,
                 s.velocity_m_per_s + by * slope.velocity_m_per_s,
                 s.bristle_m + by * slope.bristle_m};
  };
  for (int i = 0; i < parts; ++i) {
    const auto at = [&](double part) { return (i + part) / parts; };
    const auto stiffness = [&](double t) {
      return drive.stiffness_N_per_m + t * (drive.stiffness_end_N_per_m - drive.stiffness_N_per_m);
    };
    const auto force = [&](double t) {
      return drive.force_N + t * (drive.force_end_N - drive.force_N);
    };
    const double middle = at(0.5);
    const State k1 = slope(s, stiffness(at(0.0)), force(at(0.0)));
    const State k2 = slope(advanced(k1, 0.5 * h), stiffness(middle), force(middle));
    const State k3 = slope(advanced(k2, 0.5 * h), stiffness(middle), force(middle));
    const State k4 = slope(advanced(k3, h), stiffness(at(1.0)), force(at(1.0)));
    s.position_m +=
        h / 6.0 * (k1.position_m + 2.0 * (k2.position_m + k3.position_m) + k4.position_m);
    s.velocity_m_per_s += h / 6.0 *
                          (k1.velocity_m_per_s + 2.0 * (k2.velocity_m_per_s + k3.velocity_m_per_s) +
                           k4.velocity_m_per_s);
    s.bristle_m += h / 6.0 * (k1.bristle_m + 2.0 * (k2.bristle_m + k3.bristle_m) + k4.bristle_m);
  }
  // The load became too fast within the step.
  const double end_relaxation = h * std::abs(s.velocity_m_per_s) * stiffness_N_per_m_ / coulomb_N_;
  if (!(end_relaxation <= 2.0)) return coarse_step(from, drive, mechanics);
  const double max_m = static_N_ / stiffness_N_per_m_;
  bristle_m_ = std::clamp(s.bristle_m, -max_m, max_m);
  return {s.position_m, s.velocity_m_per_s};
}

}  // namespace supercoil::host_sim
