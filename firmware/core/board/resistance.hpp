// The heater's resistance, which can only be measured while current flows.
#pragma once

#include <cmath>

namespace supercoil::board {

/// R = (d·V)/I, both sides smoothed alike before the division. The current sense is averaged
/// (low-passed), so what drives it, d·V, is passed through the same low-pass first: otherwise the
/// two would be of different times while the duty changes.
class Resistance {
 public:
  struct Settings {
    double sense_filter_s = 0.0;  ///< of the averaging sense; 0: it gives the tick's mean
    double smoothing_s = 0.2;
    double probe_duty = 0.02;   ///< below this the last value is held
    double initial_Ohm = 10.0;  ///< until it is measured
    double min_Ohm = 0.1;       ///< values outside these are ignored
    double max_Ohm = 1e5;
  };
  Resistance(const Settings& settings, double step_s)
      : settings_(settings),
        step_s_(step_s),
        sense_gain_(filter_gain(settings.sense_filter_s, step_s)),
        smoothing_gain_(filter_gain(settings.smoothing_s, step_s)),
        value_Ohm_(settings.initial_Ohm) {}

  /// One tick: the duty that acted since the last one, the supply, and the averaged current.
  /// Returns whether it measured.
  bool step(double duty, double supply_V, double current_A) {
    age_s_ += step_s_;
    duty_ += sense_gain_ * (duty - duty_);
    const bool measurable =
        duty_ >= 0.99 * settings_.probe_duty && current_A > 0.0 && supply_V > 0.0;
    if (!measurable) return false;
    const double drive_V = duty_ * supply_V;
    const double weight = started_ ? smoothing_gain_ : 1.0;
    drive_V_ += weight * (drive_V - drive_V_);
    current_A_ += weight * (current_A - current_A_);
    started_ = true;
    const double measured_Ohm = drive_V_ / current_A_;
    if (!(measured_Ohm >= settings_.min_Ohm && measured_Ohm <= settings_.max_Ohm)) {
      return false;
    }
    value_Ohm_ = measured_Ohm;
    age_s_ = 0.0;
    return true;
  }

  /// A probe measured it: the smoothing restarts.
  void set(double value_Ohm) {
    value_Ohm_ = value_Ohm;
    age_s_ = 0.0;
    started_ = false;
  }

  double value_Ohm() const { return value_Ohm_; }
  double age_s() const { return age_s_; }
  /// The duty as the current sense averages it.
  double duty() const { return duty_; }

 private:
  /// Weight of the input in one step of a first-order low-pass.
  static double filter_gain(double time_constant_s, double step_s) {
    return time_constant_s > 0.0 ? -std::expm1(-step_s / time_constant_s) : 1.0;
  }

  Settings settings_;
  double step_s_;
  double sense_gain_;
  double smoothing_gain_;
  double duty_ = 0.0;
  double drive_V_ = 0.0;
  double current_A_ = 0.0;
  double value_Ohm_;
  double age_s_ = 1e9;
  bool started_ = false;
};

}  // namespace supercoil::board
