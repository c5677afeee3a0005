// Finds the position and the resistance of a cold muscle.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "modes/result.hpp"
#include "modes/stillness.hpp"

namespace supercoil::modes {

/// Waits until the muscle must be cold, or is too still to be warm; takes the mean position over a
/// second as its zero, and asks for a probe. A zero that moves while it is taken, or a resistance
/// out of range, is refused.
class Calibrate {
 public:
  struct Settings {
    double cold_K = 1.0;
    double still_K = cold_K;       ///< cold if it is still; a jammed muscle may be this hot
    double max_remaining_m = 0.0;  ///< max remaining motion when cold by stillness
    double count_m = 0.0;          ///< resolution of the position
    double max_wait_s = 120.0;
    double mean_s = 1.0;
    double max_motion_m = 100e-6;  ///< between the two halves of the mean
    double min_Ohm = 0.1;
    double max_Ohm = 1e4;
  };
  explicit Calibrate(const Settings& settings)
      : settings_(settings), stillness_(settings.mean_s, settings.count_m) {}

  void start() { *this = Calibrate(settings_); }
  /// Grows evenly with time if cooling is exponential, so it shows the remaining time.
  float progress() const { return progress_; }
  double zero_m() const { return sum_m_ / static_cast<double>(count_); }
  double cold_resistance_Ohm() const { return resistance_Ohm_; }

  /// The probe may follow.
  bool knows_zero() const { return knows_zero_; }

  /// One tick of waiting and averaging.
  ModeResult step(double hottest_K, double position_m, double step_s) {
    if (elapsed_s_ == 0.0) initial_K_ = hottest_K;
    elapsed_s_ += step_s;
    if (count_ == 0) stillness_.step(hottest_K, position_m, step_s);
    if (count_ == 0 && !is_cold(hottest_K)) {
      show_progress(cooling_s(hottest_K));
      return elapsed_s_ > settings_.max_wait_s ? ModeResult::not_cold : ModeResult::running;
    }
    if (count_ == 0) cold_after_s_ = elapsed_s_ - step_s;
    const auto ticks = static_cast<std::int64_t>(settings_.mean_s / step_s);
    const std::int64_t half = ticks / 2;
    if (count_ < half) first_half_m_ += position_m;
    sum_m_ += position_m;
    ++count_;
    show_progress(cold_after_s_);
    if (count_ < ticks) return ModeResult::running;
    const double first_m = first_half_m_ / static_cast<double>(half);
    knows_zero_ = std::abs(first_m - zero_m()) <= settings_.max_motion_m;
    return knows_zero_ ? ModeResult::running : ModeResult::moved;
  }

  /// The probe's answer.
  ModeResult probed(double resistance_Ohm) {
    resistance_Ohm_ = resistance_Ohm;
    progress_ = 1.0F;
    const bool plausible =
        resistance_Ohm >= settings_.min_Ohm && resistance_Ohm <= settings_.max_Ohm;
    return knows_zero_ && plausible ? ModeResult::found : ModeResult::implausible;
  }

 private:
  bool is_cold(double hottest_K) const {
    return hottest_K <= settings_.cold_K || (hottest_K <= settings_.still_K &&
                                             stillness_.remaining_m() <= settings_.max_remaining_m);
  }
  /// From the start until it must be cold, by the cooling so far; infinity without any.
  double cooling_s(double hottest_K) const {
    const double ends_K = hottest_K > settings_.still_K ? settings_.still_K : settings_.cold_K;
    const double cooled = std::log(initial_K_ / hottest_K) / std::log(initial_K_ / ends_K);
    return cooled > 0.0 ? std::fmin(elapsed_s_ / cooled, settings_.max_wait_s)
                        : std::numeric_limits<double>::infinity();
  }
  void show_progress(double cooling_s) {
    constexpr float before_probe = 0.99F;
    const auto done = static_cast<float>(elapsed_s_ / (cooling_s + settings_.mean_s));
    progress_ = std::fmax(progress_, before_probe * std::fmin(done, 1.0F));
  }

  Settings settings_;
  Stillness stillness_;
  double initial_K_ = 0.0;
  double elapsed_s_ = 0.0;
  double cold_after_s_ = 0.0;
  double sum_m_ = 0.0;
  double first_half_m_ = 0.0;
  std::int64_t count_ = 0;
  bool knows_zero_ = false;
  double resistance_Ohm_ = 0.0;
  float progress_ = 0.0F;
};

}  // namespace supercoil::modes
