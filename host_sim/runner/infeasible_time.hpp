// For how long a run's reference was infeasible.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "loop/feasibility.hpp"

namespace supercoil::host_sim {

/// Limits of heat: a muscle known to be colder, or proven further, would get more power.
constexpr bool is_thermal(LimitedBy limit) {
  return limit == LimitedBy::temperature || limit == LimitedBy::unproven;
}

/// Counts the ticks at which a position is followed, and those of them at such a limit for
/// infeasible_lasts_s or longer without a break.
class InfeasibleTime {
 public:
  void add(LimitedBy limit, double time_s) { add(limit, is_infeasible(limit), time_s); }
  /// excessive: the reference asks for too much, at a limit or not; the infeasible time lasts as
  /// long.
  void add(LimitedBy limit, bool excessive, double time_s) {
    ++following_;
    if (!excessive) return interrupt();
    if (std::isnan(since_s_)) since_s_ = time_s;
    if (!is_infeasible(limit)) return leave_limit();
    if (std::isnan(at_limit_since_s_)) at_limit_since_s_ = time_s;
    ++open_.at(static_cast<std::size_t>(limit));
    if (time_s - at_limit_since_s_ < infeasible_lasts_s - rounding_s) return;
    if (std::isnan(first_s_)) first_s_ = since_s_;
    if (first_s_ == since_s_) first_until_s_ = time_s;
    for (std::size_t i = 0; i < open_.size(); ++i)
      counted_.at(i) += std::exchange(open_.at(i), 0);
  }
  /// No position is followed at this tick.
  void interrupt() {
    since_s_ = NAN;
    leave_limit();
  }

  /// For however long: a step that cannot be made is infeasible in a long run as well.
  bool found() const { return !std::isnan(first_s_); }
  /// Infeasible ticks over all that followed a position; NaN: none did.
  double ratio() const {
    const auto all = std::accumulate(counted_.begin(), counted_.end(), std::int64_t{0});
    return static_cast<double>(all) / static_cast<double>(following_);
  }
  /// When the reference first became infeasible; NaN: never.
  double first_s() const { return first_s_; }
  /// From then to the last infeasible tick without a break.
  double first_duration_s() const { return first_until_s_ - first_s_; }
  bool first_ended() const { return since_s_ != first_s_; }
  /// The limit that held for most of the infeasible time.
  LimitedBy main_limit() const {
    return static_cast<LimitedBy>(std::ranges::max_element(counted_) - counted_.begin());
  }

 private:
  static constexpr double rounding_s = 1e-9;
  using Ticks = std::array<std::int64_t, limit_names.size()>;

  void leave_limit() {
    if (std::isnan(at_limit_since_s_)) return;  // nothing is open
    at_limit_since_s_ = NAN;
    open_.fill(0);
  }

  std::int64_t following_ = 0;
  Ticks counted_{};
  Ticks open_{};                   ///< at a limit, but not yet for long enough
  double since_s_ = NAN;           ///< since when the reference asks for too much
  double at_limit_since_s_ = NAN;  ///< since when the muscle is also at a limit
  double first_s_ = NAN;
  double first_until_s_ = NAN;
};

}  // namespace supercoil::host_sim
