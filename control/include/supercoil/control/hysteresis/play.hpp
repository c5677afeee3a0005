// The play operator, of which models of hysteresis are made.
#pragma once

#include <algorithm>

namespace supercoil::control {

/// An output that follows its input only when that has moved by a radius from it, as the far side
/// of a gear with backlash does (Brokate & Sprekels, Hysteresis and Phase Transitions, 1996).
class Play {
 public:
  /// radius: >= 0, in the input's unit.
  explicit Play(double radius) : radius_(radius) {}
  /// Follows its input at once.
  Play() = default;

  /// Without memory: the output is where the input is.
  void rest_at(double input) { output_ = input; }
  /// radius: >= 0. The output stays until the next step.
  void set_radius(double radius) { radius_ = radius; }
  /// Carries the output along as far as the input is more than the radius from it.
  void step(double input) {
    const double before = output_;
    output_ = std::clamp(output_, input - radius_, input + radius_);
    engaged_ = output_ != before;
  }
  double output() const { return output_; }
  /// The last step carried the output along.
  bool engaged() const { return engaged_; }

 private:
  double radius_ = 0.0;
  double output_ = 0.0;
  bool engaged_ = false;
};

}  // namespace supercoil::control
