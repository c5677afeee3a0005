// Detects that a muscle's end no longer rises while its power does.
#pragma once

namespace supercoil::operating {

/// Compares the rise for equal steps of a slowly rising power. The rise of a nonlinear muscle
/// varies by a factor of two over its travel; a muscle whose end touches something stands still.
class StallWatch {
 public:
  /// noise_m: of the position, rms.
  StallWatch(double step_W, double noise_m) : step_W_(step_W), min_usual_m_(6.0 * noise_m) {}

  /// True: over the last two steps it rose by less than a fifth of what it did before.
  bool step(double power_W, double position_m) {
    if (power_W < next_W_) return false;
    const double rise_m = position_m - last_m_;
    const bool first = steps_ < 0;
    const double usual_m = steps_ > 0 ? risen_m_ / steps_ : 0.0;
    const bool slow = usual_m > min_usual_m_ && rise_m < 0.2 * usual_m;
    slow_steps_ = slow ? slow_steps_ + 1 : 0;
    if (!slow) {
      risen_m_ += first ? 0.0 : rise_m;
      ++steps_;
    }
    next_W_ = power_W + step_W_;
    last_m_ = position_m;
    return slow_steps_ == 2;
  }

 private:
  double step_W_;
  double min_usual_m_;
  double next_W_ = 0.0;
  double last_m_ = 0.0;
  double risen_m_ = 0.0;  ///< in the steps that were not slow
  int steps_ = -1;        ///< of these; negative: before the first position
  int slow_steps_ = 0;    ///< in a row
};

}  // namespace supercoil::operating
