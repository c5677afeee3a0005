// What q8.24 can hold: signals and gains in 8 bits before the point, states in 16.
#pragma once

#include <optional>

namespace supercoil::control {

/// A value outside its allowed range: its name, and the range (ends included).
struct Violation {
  const char* quantity;
  double value;
  double min;
  double max;
};

/// Remembers the first quantity that fixed point cannot hold.
class FixedPointFit {
 public:
  static constexpr double signal = 127.0;
  static constexpr double state = 32767.0;

  /// quantity: the setting's name in configurations.
  void at_most(const char* quantity, double value, double max) {
    check({quantity, value, -max, max});
  }
  /// A gain below min_gain is lost in rounding.
  void gain(const char* quantity, double value) { check({quantity, value, min_gain, signal}); }
  const std::optional<Violation>& violation() const { return violation_; }

 private:
  static constexpr double min_gain = 16.0 / (1 << 24);

  void check(const Violation& v) {
    if (!violation_ && !(v.value >= v.min && v.value <= v.max)) violation_ = v;
  }
  std::optional<Violation> violation_;
};

}  // namespace supercoil::control
