// Learning a muscle's parameters on command.
#pragma once

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/estimation/batch_least_squares.hpp"

#include "modes/excitation.hpp"
#include "modes/result.hpp"

namespace supercoil::modes {

/// Excites the muscle for a minute, fits it, and hands the result over only if it passes its own
/// validation: it explains the last third of the experiment, which was not fitted; the physical
/// parameters exist; and each lies within its span of what the configuration believes.
class Identify {
 public:
  struct Settings {
    double duration_s = 60.0;
    double most_unexplained = 0.01;  ///< of the unseen third's energy
    double most_error = 0.2;         ///< relative bound on all parameters together
    double least_part = 0.2;         ///< each θ within these parts of the believed muscle's
    double most_part = 5.0;
  };
  Identify(const Settings& settings, const control::PhysicalParameters& believed, double step_s)
      : settings_(settings), believed_(believed), step_s_(step_s), fit_(fresh_fit()) {}

  void start() {
    elapsed_s_ = 0.0;
    fit_ = fresh_fit();
  }
  double power_W(double max_W) const { return excitation_W(elapsed_s_, max_W); }
  float progress() const { return static_cast<float>(elapsed_s_ / settings_.duration_s); }
  const control::PhysicalParameters& found() const { return found_; }

  /// One tick: this tick's position, and the power applied since the last one.
  ModeResult step(double position_m, double applied_power_W) {
    elapsed_s_ += step_s_;
    fit_.step(position_m, applied_power_W);
    return elapsed_s_ < settings_.duration_s ? ModeResult::running : judge();
  }

 private:
  control::BatchLeastSquares fresh_fit() const {
    control::BatchLeastSquares::Settings s;
    s.scale = {control::theta_from(believed_), believed_.dc_gain_m_per_W(),
               believed_.moving_mass_kg};
    return {s, settings_.duration_s, step_s_};
  }

  ModeResult judge() {
    const auto fit = fit_.fit();
    if (!fit || !(fit->unexplained_part <= settings_.most_unexplained))
      return ModeResult::not_explained;
    if (!(fit->relative_error_bound <= settings_.most_error)) return ModeResult::uncertain;
    const control::Theta nominal = control::theta_from(believed_);
    for (int i = 0; i < 4; ++i) {
      const double part = fit->theta[i] / nominal[i];
      if (!(part >= settings_.least_part && part <= settings_.most_part))
        return ModeResult::implausible;
    }
    const auto physical = control::physical_from(
        fit->theta, {believed_.force_per_kelvin_N_per_K, believed_.moving_mass_kg});
    if (!physical || control::check(*physical)) return ModeResult::implausible;
    found_ = *physical;
    return ModeResult::found;
  }

  Settings settings_;
  control::PhysicalParameters believed_;
  double step_s_;
  double elapsed_s_ = 0.0;
  control::BatchLeastSquares fit_;
  control::PhysicalParameters found_;
};

}  // namespace supercoil::modes
