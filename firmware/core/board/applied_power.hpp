// The power that acts now, when a duty acts only some time after it was set.
#pragma once

#include <array>
#include <cstddef>

namespace supercoil::board {

/// The power that a duty gives for a tick.
struct AppliedPower {
  double power_W = 0.0;
  double duty = 0.0;
  bool limited = false;   ///< it differs from the demand
  double dither_W = 0.0;  ///< part of power_W, added to see whether the muscle answers
};

/// A delay line of whole ticks, up to 255. As short as possible, so that it stays in the cache.
class OutputDelay {
 public:
  static constexpr std::size_t max_ticks = 255;

  explicit OutputDelay(std::size_t ticks) : ticks_(ticks < max_ticks ? ticks : max_ticks) {}

  /// Takes what was set at this tick; returns what acts from now on.
  AppliedPower step(const AppliedPower& set) {
    if (ticks_ == 0) return set;
    line_[head_] = set;
    head_ = head_ == ticks_ ? 0 : head_ + 1;
    return line_[head_];
  }

 private:
  std::size_t ticks_;
  std::size_t head_ = 0;
  std::array<AppliedPower, max_ticks + 1> line_{};
};

}  // namespace supercoil::board
