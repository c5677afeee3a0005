// How long a reference was none that the muscle could follow, found in a run.
#pragma once

#include <cmath>
#include <cstdint>

#include "loop/feasibility.hpp"

namespace supercoil::host_sim {

/// What shaping of the reference does not know.
constexpr bool is_of_heat(LimitedBy limit) {
  return limit == LimitedBy::temperature || limit == LimitedBy::unproven;
}

/// Counts the ticks that follow a position, and of these the ones that are at such a limit for
/// infeasible_lasts_s or longer on end.
class InfeasibleTime {
 public:
  void add(LimitedBy limit, double time_s) {
    ++following_;
    if (!is_infeasible(limit)) return interrupt();
    if (std::isnan(since_s_)) since_s_ = time_s;
    ++open_;
    if (time_s - since_s_ < infeasible_lasts_s - rounding_s) return;
    if (infeasible_ == 0) {
      first_s_ = since_s_;
      first_by_ = limit;
    }
    infeasible_ += open_;
    open_ = 0;
  }
  /// No position is followed at this tick.
  void interrupt() {
    since_s_ = NAN;
    open_ = 0;
  }

  /// NaN: none was followed.
  double ratio() const {
    return static_cast<double>(infeasible_) / static_cast<double>(following_);
  }
  /// When that began first; NaN: never.
  double first_s() const { return first_s_; }
  LimitedBy first_by() const { return first_by_; }

 private:
  static constexpr double rounding_s = 1e-9;

  std::int64_t following_ = 0;
  std::int64_t infeasible_ = 0;
  std::int64_t open_ = 0;  ///< at a limit, and not for long enough yet
  double since_s_ = NAN;   ///< at a limit
  double first_s_ = NAN;
  LimitedBy first_by_ = LimitedBy::nothing;
};

}  // namespace supercoil::host_sim
