#include "estimators/trial.hpp"

#include <cmath>
#include <cstdint>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/estimation/gradient.hpp"

namespace supercoil::host_sim::estimators {

namespace {

constexpr double softened_N_per_m = 12.0;

}  // namespace

control::Theta Trial::initial() const {
  if (paper_start) return control::GradientSettings{}.initial;
  constexpr double part = 0.6;
  return control::theta_from({}).cwiseProduct(control::Theta{part, 1.0 / part, part, 1.0 / part});
}

Bench::Bench(const Trial& trial, std::uint64_t seed)
    : trial_(trial),
      plant_({}, tick_s),
      truth_(control::theta_from(plant_.parameters())),
      source_(static_cast<std::uint32_t>(seed)),
      noise_(0.0, 1.0),
      change_at_(std::llround(trial.change_at_s / tick_s)),
      end_(std::llround(trial.duration_s / tick_s)) {}

Bench::Tick Bench::next() {
  const double power_W = excitation_.at(static_cast<double>(ticks_) * tick_s);
  plant_.step(power_W);
  ++ticks_;
  const double seen_m = plant_.position_m() + trial_.noise_m * noise_(source_);
  const double count_m = trial_.count_m();
  if (ticks_ == change_at_) soften();
  return {static_cast<double>(ticks_) * tick_s,
          count_m > 0.0 ? std::nearbyint(seen_m / count_m) * count_m : seen_m, power_W};
}

void Bench::soften() {
  control::PhysicalParameters softer = plant_.parameters();
  softer.stiffness_N_per_m = softened_N_per_m;
  plant_.set_parameters(softer);
  truth_ = control::theta_from(softer);
}

State Bench::state() const {
  const control::PhysicalParameters& p = plant_.parameters();
  State state = state_of(truth_);
  state[at_position] = plant_.position_m();
  state[at_velocity] = plant_.velocity_m_per_s();
  const double force_N = p.force_per_kelvin_N_per_K * plant_.temperature_rise_K() -
                         p.stiffness_N_per_m * plant_.position_m() -
                         p.damping_Ns_per_m * plant_.velocity_m_per_s();
  state[at_acceleration] = force_N / p.moving_mass_kg;
  return state;
}

}  // namespace supercoil::host_sim::estimators
