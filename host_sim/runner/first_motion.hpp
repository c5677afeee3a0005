// The first motion of `supercoil setup`, as a scenario's operator commands it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "loop/loop.hpp"
#include "loop/promise.hpp"

namespace supercoil::host_sim {

/// Planned from what the board knows of its muscle, and judged over its last period.
class FirstMotionRun {
 public:
  /// board: of this loop. place: of the controller in use, in the channel's list.
  FirstMotionRun(const Loop& loop, const BoardSettings& board, std::size_t place, double begin_s);

  /// The reference; NaN: the motion is over.
  double reference_m(double time_s) const;
  /// Call after each tick of the motion.
  void update(double time_s, const Snapshot& snapshot);

  /// NaN: the controller's law promises none.
  double promised_rms_m() const { return promised_rms_m_; }
  /// Position minus reference model, as the board's sensor shows it. NaN: the motion was not
  /// completed.
  double rms_m() const;

 private:
  FirstMotion motion_;
  double begin_s_;
  double promised_rms_m_ = NAN;
  double square_sum_ = 0.0;
  std::int64_t ticks_ = 0;
  bool ended_ = false;
};

}  // namespace supercoil::host_sim
