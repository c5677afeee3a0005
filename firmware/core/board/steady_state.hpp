// A muscle's rise, read from a thermometer while it neither warms nor cools.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "board/known_heat.hpp"
#include "board/learned.hpp"
#include "supervisor/channel_state.hpp"

namespace supercoil::board {

/// In steady heat η is power over rise, at that rise. A muscle is steady after five of the slowest
/// time constants that it may have, at unchanged power: e⁻⁵ of the initial difference is left.
class SteadyState {
 public:
  SteadyState(const ThermalSettings& settings, double step_s)
      : settings_(settings),
        slowest_s_(control::max_time_constant_s(with_weighed_mass(settings))),
        steady_ticks_(std::llround(slowest_constants * slowest_s_ / step_s)),
        smoothing_(-std::expm1(-2.0 * step_s / slowest_s_)) {}

  /// A tick at unchanged power, with the bounds of the measurement, and the hot end.
  void step(const PowerBounds::Interval& measured_power_W, double hottest_K) {
    if (ticks_++ == 0) {
      measured_power_W_ = measured_power_W;
      from_K_ = hottest_K;
    }
    measured_power_W_.min += smoothing_ * (measured_power_W.min - measured_power_W_.min);
    measured_power_W_.max += smoothing_ * (measured_power_W.max - measured_power_W_.max);
  }
  /// The power changes, or is not known.
  void restart() { ticks_ = 0; }

  /// rise_K: how much warmer the muscle is than the air. A reading that contradicts what is known
  /// is refused; one that is accepted is added to facts.
  Refusal read(double rise_K, const PowerBounds::Interval& true_over_measured,
               board::ThermalFacts& facts) const {
    if (ticks_ < steady_ticks_) return Refusal::not_ready;
    const double error_K =
        settings_.thermometer_error_K + std::exp(-slowest_constants) * std::max(from_K_, rise_K);
    // Written so that a NaN is refused.
    if (!(rise_K >= min_errors * error_K && rise_K <= max_K)) return Refusal::out_of_range;
    board::ThermalFacts read = facts;
    read.steady_rise_K = rise_K;
    read.steady_error_K = error_K;
    read.steady_min_W = measured_power_W_.min;
    read.steady_max_W = measured_power_W_.max;
    if (!is_possible(known_thermal_bounds(settings_, facts), read, true_over_measured))
      return Refusal::out_of_range;
    facts = read;
    return Refusal::none;
  }

 private:
  static constexpr double slowest_constants = 5.0;
  static constexpr double min_errors = 3.0;  ///< a rise below this many errors says nothing
  static constexpr double max_K = 300.0;

  ThermalSettings settings_;
  double slowest_s_;
  std::int64_t steady_ticks_;
  double smoothing_;
  std::int64_t ticks_ = 0;
  PowerBounds::Interval measured_power_W_{0.0, 0.0};
  double from_K_ = 0.0;  ///< the hot end when the power last changed
};

}  // namespace supercoil::board
