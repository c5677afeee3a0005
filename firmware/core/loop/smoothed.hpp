// A value with less noise, and without lag while it moves steadily.
#pragma once

namespace supercoil {

/// Two equal low-passes in a row: twice the first less the second has no lag on a ramp.
class Smoothed {
 public:
  Smoothed(double time_constant_s, double step_s) : gain_(step_s / (time_constant_s + step_s)) {}

  /// One tick.
  void step(double value) {
    once_ += gain_ * (value - once_);
    twice_ += gain_ * (once_ - twice_);
  }
  /// As if the value had been constant for long.
  void set(double value) { once_ = twice_ = value; }
  double value() const { return 2.0 * once_ - twice_; }

 private:
  double gain_;
  double once_ = 0.0;
  double twice_ = 0.0;
};

}  // namespace supercoil
