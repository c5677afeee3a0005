// Does the position answer the power as the muscle's model says? A matched filter.
#pragma once

#include <cmath>

#include "supervisor/detectors/margin.hpp"

namespace supercoil::detectors {

/// Removes the slow part: drift of the rest length and of the air, and what a model does not know
/// of them. Two equal high-passes.
class HighPass {
 public:
  HighPass(double corner_rad_per_s, double step_s)
      : gain_(-std::expm1(-corner_rad_per_s * step_s)) {}

  /// One step; returns the value without its slow part.
  double step(double value) {
    first_ += gain_ * (value - first_);
    const double filtered_once = value - first_;
    second_ += gain_ * (filtered_once - second_);
    return filtered_once - second_;
  }
  /// As after a long time at this value.
  void settle(double value) {
    first_ = value;
    second_ = 0.0;
  }

 private:
  double gain_;
  double first_ = 0.0;
  double second_ = 0.0;
};

/// Sums over a block: the expected motion squared, and times the measured one. A block is decided
/// when its expected motion is needed_deviations times the noise of the measured ratio.
class Response {
 public:
  // One-sided tails of a normal distribution. 1e-3 of dead muscles pass. Of live ones whose answer
  // is half of the model's, less than 1e-9 fail: 3e-10, and twice that as open blocks are judged
  // again. (Identified: within 15 %; the rest is for hysteresis, which affects small motions most.)
  static constexpr double missed_deviations = 3.1;
  static constexpr double false_deviations = 6.2;
  static constexpr double min_response_ratio = 0.5;
  static constexpr double needed_deviations =
      (missed_deviations + false_deviations) / min_response_ratio;
  /// A smaller ratio of measured to expected motion is no response.
  static constexpr double silent_ratio = missed_deviations / needed_deviations;

  /// Of a block: not decided yet, the muscle followed its power, or it did not.
  enum class Result { open, answered, silent };

  /// noise_m: standard deviation of one measured value, > 0.
  explicit Response(double noise_m) : variance_m2_(noise_m * noise_m) {}

  void restart() { expected_ = shared_ = measured_ = count_ = 0.0; }

  /// Both values without their slow part.
  Result step(double expected_m, double measured_m) {
    expected_ += expected_m * expected_m;
    shared_ += expected_m * measured_m;
    measured_ += measured_m * measured_m;
    count_ += 1.0;
    if (count_ < min_count || expected_ < square(needed_deviations) * variance_m2_)
      return Result::open;
    if (ratio() < silent_ratio) return is_quiet() ? Result::silent : Result::open;
    const bool certain = square(ratio()) * expected_ >= square(false_deviations) * noise_m2();
    return certain ? Result::answered : Result::open;
  }
  /// Whether the position moved by more than this, rms over the block, for whatever reason.
  bool moved(double rms_m) const { return measured_ > square(rms_m) * (count_ + min_count); }
  /// Measured over expected motion in this block; 0 before anything was expected.
  double ratio() const { return expected_ > 0.0 ? shared_ / expected_ : 0.0; }

 private:
  /// As responding_ratio, of the expected motion: a muscle that moves more, in any way, is not
  /// dead.
  static constexpr double moved_ratio = 0.3;
  /// With fewer values the residual's own size is too uncertain.
  static constexpr double min_count = 10.0;

  static double square(double x) { return x * x; }

  /// The sensor's noise or the model's residual, whichever is larger.
  double noise_m2() const {
    return std::fmax(variance_m2_, (measured_ - shared_ * ratio()) / (count_ - 1.0));
  }
  /// Motion not caused by the power does not prove that the muscle is dead.
  bool is_quiet() const {
    const bool enough = expected_ >= square(needed_deviations) * noise_m2();
    const double quiet_m2 = std::fmax(4.0 * count_ * variance_m2_, square(moved_ratio) * expected_);
    return enough && measured_ <= quiet_m2;
  }

  double variance_m2_;
  double expected_ = 0.0;
  double shared_ = 0.0;
  double measured_ = 0.0;
  double count_ = 0.0;
};

/// A margin that was computed elsewhere.
class ReportedMargin final : public Detector {
 public:
  bool step(bool trips, const Margin& margin) {
    margin_ = margin;
    return trips;
  }
  Margin margin() const override { return margin_; }

 private:
  Margin margin_;
};

}  // namespace supercoil::detectors
