// Distinguishes a loop that oscillates by itself from poor tracking and from noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace supercoil::control {

/// Detects a sustained oscillation of the tracking error: `half_periods` in a row, alike in
/// length within 30 % and in amplitude within a factor of two, faster than `slow` and slower than
/// `fast`, while the reference model moves by less than half as much at such frequencies. Noise is
/// not that regular; a reference that oscillates moves the model.
class OscillationDetector {
 public:
  /// Which oscillations count; slow < fast.
  struct Settings {
    double slow_rad_per_s = 2.0;
    double fast_rad_per_s = 40.0;
    double min_amplitude_m = 50e-6;  ///< five times the expected position noise
    int half_periods = 10;
  };

  /// step_s: > 0, between ticks.
  explicit OscillationDetector(double step_s) : OscillationDetector(step_s, Settings{}) {}
  OscillationDetector(double step_s, const Settings& s)
      : settings_(s),
        step_s_(step_s),
        fast_smoothing_(-std::expm1(-s.fast_rad_per_s * step_s)),
        slow_smoothing_(-std::expm1(-s.slow_rad_per_s * step_s)) {}

  /// Forgets the error's past, which belongs to another law.
  void restart() {
    error_ = model_ = {};
    sign_ = 0;
    begin_half_period();
    start_counting();
  }

  /// One tick: tracking error, and position of the reference model. True once for every
  /// `half_periods` of an oscillation.
  bool step(double error_m, double model_m) {
    const double error = error_.step(error_m, fast_smoothing_, slow_smoothing_);
    const double model = model_.step(model_m, fast_smoothing_, slow_smoothing_);
    half_s_ += step_s_;
    peak_m_ = std::max(peak_m_, std::abs(error));
    model_peak_m_ = std::max(model_peak_m_, std::abs(model));
    if (half_s_ > std::numbers::pi / settings_.slow_rad_per_s) start_counting();
    if (std::abs(error) <= settings_.min_amplitude_m) return false;
    const int sign = error > 0.0 ? 1 : -1;
    if (sign == sign_) return false;
    const bool first = sign_ == 0;
    sign_ = sign;
    const bool found = !first && end_half_period();
    begin_half_period();
    return found;
  }

  /// Period of the last oscillation detected; 0: none yet.
  double period_s() const { return period_s_; }

 private:
  /// First-order band-pass between the slow and the fast limit.
  struct Band {
    double fast_m = 0.0;
    double slow_m = 0.0;
    double step(double value_m, double fast_smoothing, double slow_smoothing) {
      fast_m += fast_smoothing * (value_m - fast_m);
      slow_m += slow_smoothing * (fast_m - slow_m);
      return fast_m - slow_m;
    }
  };

  void start_counting() {
    count_ = 0;
    mean_half_s_ = mean_peak_m_ = 0.0;
  }
  void begin_half_period() { half_s_ = peak_m_ = model_peak_m_ = 0.0; }

  bool end_half_period() {
    const bool own =
        half_s_ > std::numbers::pi / settings_.fast_rad_per_s && model_peak_m_ < 0.5 * peak_m_;
    const bool alike =
        count_ == 0 || (std::abs(half_s_ - mean_half_s_) < 0.3 * mean_half_s_ &&
                        peak_m_ < 2.0 * mean_peak_m_ && mean_peak_m_ < 2.0 * peak_m_);
    if (!own || !alike) {
      start_counting();
      return false;
    }
    const double smoothing = count_ == 0 ? 1.0 : 0.3;
    mean_half_s_ += smoothing * (half_s_ - mean_half_s_);
    mean_peak_m_ += smoothing * (peak_m_ - mean_peak_m_);
    if (++count_ < settings_.half_periods) return false;
    period_s_ = 2.0 * mean_half_s_;
    start_counting();
    return true;
  }

  Settings settings_;
  double step_s_;
  double fast_smoothing_;
  double slow_smoothing_;
  Band error_;
  Band model_;
  int sign_ = 0;
  int count_ = 0;             // of half periods alike, in a row
  double mean_half_s_ = 0.0;  // of those
  double mean_peak_m_ = 0.0;
  double half_s_ = 0.0;  // of the present half period
  double peak_m_ = 0.0;
  double model_peak_m_ = 0.0;
  double period_s_ = 0.0;
};

}  // namespace supercoil::control
