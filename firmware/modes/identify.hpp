// Learning a muscle's parameters on command.
#pragma once

#include <optional>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/estimation/estimator.hpp"

#include "modes/excitation.hpp"

namespace supercoil::modes {

/// Excites the muscle until the estimates deserve trust, and hands them over only if they pass
/// their own validation: the present θ explains the whole last window to within error, the physical
/// parameters exist, and each lies within its span of what the configuration believes.
class Identify {
 public:
  enum class Outcome { running, found, failed };
  struct Settings {
    double longest_s = 300.0;
    double error = 0.1;       ///< relative bound on all parameters together
    double least_part = 0.2;  ///< each θ within these parts of the configured muscle's
    double most_part = 5.0;
  };
  explicit Identify(const Settings& settings) : settings_(settings) {}

  void start() { elapsed_s_ = 0.0; }
  double power_W(double max_W) const { return excitation_W(elapsed_s_, max_W); }
  float progress() const { return static_cast<float>(elapsed_s_ / settings_.longest_s); }
  const control::PhysicalParameters& found() const { return found_; }

  /// One tick. estimate is empty when the channel has no estimator: nothing can then be learned.
  Outcome step(const std::optional<control::Estimate>& estimate,
               const control::PhysicalParameters& believed, double step_s) {
    elapsed_s_ += step_s;
    const bool late = elapsed_s_ >= settings_.longest_s;
    if (!estimate || !(estimate->relative_error_bound <= settings_.error)) {
      return late || !estimate ? Outcome::failed : Outcome::running;
    }
    const auto physical = control::physical_from(
        estimate->theta, {believed.force_per_kelvin_N_per_K, believed.moving_mass_kg});
    const control::Theta nominal = control::theta_from(believed);
    for (int i = 0; i < 4; ++i) {
      const double part = estimate->theta[i] / nominal[i];
      if (!(part >= settings_.least_part && part <= settings_.most_part)) return Outcome::failed;
    }
    if (!physical || control::check(*physical)) return Outcome::failed;
    found_ = *physical;
    return Outcome::found;
  }

 private:
  Settings settings_;
  double elapsed_s_ = 0.0;
  control::PhysicalParameters found_;
};

}  // namespace supercoil::modes
