// What a channel's muscle can do, calculated before it is heated.
#pragma once

#include <optional>
#include <vector>

#include "loop/settings.hpp"

namespace supercoil {

/// How far steps through a controller's reference model may go. Beyond that the muscle would need
/// active cooling or more than the maximum power.
struct FeasibleSteps {
  double up_m = 0.0;    ///< from rest
  double down_m = 0.0;  ///< from the top of the travel; NaN: a joint's other muscle helps
  bool shaped = false;  ///< larger steps are shaped so that the muscle can follow them
};

/// By the linear model of the muscle as configured or identified.
struct Feasibility {
  double max_W = 0.0;   ///< for seconds: the limiter, or the lowest supply at the cold resistance
  double held_W = 0.0;  ///< indefinitely
  LimitedBy held_by = LimitedBy::maximum;  ///< what bounds held_W
  double travel_m = 0.0;                   ///< what held_W holds, up to max_travel_m
  double rise_s = 0.0;                     ///< 10 to 90 % of the travel at max_W
  double fall_s = 0.0;                     ///< 90 to 10 % of it without power
  double half_travel_period_s = 0.0;       ///< the fastest sine over the middle half of the travel
  /// How far the coldest air lowers the rest position compared with the warmest; 0 in a joint of
  /// two muscles.
  double air_shift_m = 0.0;
  double cold_travel_m = 0.0;  ///< held in the coldest, above a zero that was taken in the warmest
  bool rest_seen = true;       ///< the sensor can read that far below its zero
  double armable_s = 0.0;      ///< after boot, at the latest; infinite: never
  std::vector<std::optional<FeasibleSteps>> steps;  ///< of each controller; empty: open loop
};

/// Whether the limit means that the muscle cannot follow the reference. Not so for `slew`, which
/// ends by itself, nor for `invalid`, a demand that is NaN.
constexpr bool is_infeasible(LimitedBy limit) {
  return limit != LimitedBy::nothing && limit != LimitedBy::slew && limit != LimitedBy::invalid;
}
/// A limit must last this long without a break: the same rule before a run, after it and on the
/// page. Noise and a first step also reach limits, but for less time. A fraction of the time would
/// not do: an infeasible step would not count in a long run.
inline constexpr double infeasible_lasts_s = 0.2;

/// How far a load, if known, draws the muscle below its zero.
inline double load_m(const ChannelSettings& channel) {
  return channel.simulated.load_N / channel.muscle.stiffness_N_per_m;
}

/// channel: of this board. Allocates: not for a tick.
Feasibility feasibility(const ChannelSettings& channel, const BoardSettings& board);

/// How far the coldest air lowers this muscle alone, compared with the warmest.
double air_shift_m(const ChannelSettings& channel);

/// The peak of power at the beginning of a step by 1 m through the reference model.
double peak_W_per_m(const control::ReferenceModelSettings& settings,
                    const control::PhysicalParameters& muscle);

/// The maximum pull from heat while the muscle is held still: steady at power_W with the minimum
/// heat transfer of its bounds, at most heated from the coldest air to its trip.
double hottest_pull_N(const ChannelSettings& channel, double power_W);

}  // namespace supercoil
