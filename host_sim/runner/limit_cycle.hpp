// A limit cycle under a reference that moves, found after a run.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "supervisor/limiter.hpp"

namespace supercoil::host_sim {

/// An oscillating loop takes its power from one limit to the other and back with a constant period.
/// Noise reaches both limits at irregular times, and a reference does so with its own period.
class LimitCycle {
 public:
  /// A tick at this limit that the reference did not ask for.
  void add(LimitedBy limit, double time_s) {
    const bool at_limit = limit == LimitedBy::minimum || limit == LimitedBy::maximum;
    if (!at_limit || limit == last_) return;
    last_ = limit;
    if (limit == LimitedBy::minimum) return;
    if (!std::isnan(risen_s_)) lasted_s_.at(count_++ % lasted_s_.size()) = time_s - risen_s_;
    risen_s_ = time_s;
  }
  /// No position is followed at this tick.
  void interrupt() {
    last_ = LimitedBy::nothing;
    risen_s_ = NAN;
  }
  /// The period of the newest cycles, if most of them last about as long, below a third of
  /// max_period_s; otherwise NaN.
  double period_s(double max_period_s) const {
    std::array<double, 256> sorted = lasted_s_;
    const std::span all(sorted.data(), std::min<std::size_t>(count_, sorted.size()));
    if (all.size() < min_cycles) return NAN;
    std::ranges::sort(all);
    const double middle_s = all[all.size() / 2];
    const auto alike = std::ranges::count_if(all, [&](double lasted_s) {
      return std::abs(lasted_s - middle_s) < alike_ratio * middle_s;
    });
    const bool regular =
        static_cast<double>(alike) > min_alike_fraction * static_cast<double>(all.size());
    return regular && middle_s < max_period_s / 3.0 ? middle_s : NAN;
  }

 private:
  static constexpr std::size_t min_cycles = 12;
  static constexpr double alike_ratio = 0.25;
  /// In the built-in scenarios: a seventh are alike with noise, four fifths with too much gain.
  static constexpr double min_alike_fraction = 0.5;

  LimitedBy last_ = LimitedBy::nothing;
  double risen_s_ = NAN;  ///< when it last came to the maximum
  std::array<double, 256> lasted_s_{};
  std::size_t count_ = 0;
};

}  // namespace supercoil::host_sim
