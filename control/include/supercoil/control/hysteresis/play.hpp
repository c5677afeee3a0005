// The play operator, from which models of hysteresis are built.
#pragma once

#include <algorithm>

namespace supercoil::control {

/// An output that follows its input only once the input is a radius away, like the far side of a
/// gear with backlash (Brokate & Sprekels, Hysteresis and Phase Transitions, 1996).
class Play {
 public:
  /// radius: >= 0, in the input's unit.
  explicit Play(double radius) : radius_(radius) {}
  /// Radius 0: the output follows its input at once.
  Play() = default;

  /// Clears the memory: the output equals the input.
  void rest_at(double input) { output_ = input; }
  /// radius: >= 0. The output stays until the next step.
  void set_radius(double radius) { radius_ = radius; }
  /// Moves the output so far that the input is no more than the radius away.
  void step(double input) {
    const double before = output_;
    output_ = std::clamp(output_, input - radius_, input + radius_);
    engaged_ = output_ != before;
  }
  double output() const { return output_; }
  /// True when the last step moved the output.
  bool engaged() const { return engaged_; }

 private:
  double radius_ = 0.0;
  double output_ = 0.0;
  bool engaged_ = false;
};

}  // namespace supercoil::control
