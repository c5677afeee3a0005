// What a channel's muscle can do, told before it is heated.
#pragma once

#include <optional>
#include <vector>

#include "loop/settings.hpp"

namespace supercoil {

/// How far steps through a controller's reference model may go. More than that, the muscle would
/// have to be cooled, or to get more than the greatest power.
struct FeasibleSteps {
  double up_m = 0.0;    ///< from rest
  double down_m = 0.0;  ///< from the top of the travel
  bool shaped = false;  ///< larger ones are shaped, so that the muscle follows them as it can
};

/// By the linear model of the muscle as it is configured, or was identified.
struct Feasibility {
  double max_W = 0.0;   ///< for seconds: the limiter, or the lowest supply over the cold resistance
  double held_W = 0.0;  ///< for good
  LimitedBy held_by = LimitedBy::maximum;  ///< what bounds held_W
  double travel_m = 0.0;                   ///< what held_W holds, up to max_travel_m
  double rise_s = 0.0;                     ///< 10 to 90 % of the travel at max_W
  double fall_s = 0.0;                     ///< 90 to 10 % of it without power
  double half_travel_period_s = 0.0;       ///< the fastest sine over the middle half of the travel
  /// How far the coldest air draws the rest position below that in the warmest.
  double air_shift_m = 0.0;
  double cold_travel_m = 0.0;  ///< held in the coldest, above a zero that was taken in the warmest
  bool rest_seen = true;       ///< the sensor reads so far below its zero
  double armable_s = 0.0;      ///< after boot, at the latest; infinite: never
  std::vector<std::optional<FeasibleSteps>> steps;  ///< of each controller; empty: in open loop
};

/// That a limit takes power because the reference is none that the muscle can follow. Not a rise
/// that is slowed, which ends by itself, nor what is no number.
constexpr bool is_infeasible(LimitedBy limit) {
  return limit != LimitedBy::nothing && limit != LimitedBy::slew && limit != LimitedBy::invalid;
}
/// For so long on end: one rule before a run, after it and on the page. Shorter, noise or a first
/// step is at a limit as well. Part of the time is no rule: a step that cannot be made would be
/// none in a long run.
inline constexpr double infeasible_lasts_s = 0.2;

/// By how much a load, where one is known, draws the muscle below its zero.
inline double load_m(const ChannelSettings& channel) {
  return channel.simulated.load_N / channel.muscle.stiffness_N_per_m;
}

Feasibility feasibility(const ChannelSettings& channel, const BoardSettings& board);

/// A step asks for a peak of power at its beginning: of one by 1 m through the reference model.
double peak_W_per_m(const control::ReferenceModelSettings& settings,
                    const control::PhysicalParameters& muscle);

/// That heat may make the muscle pull with while it is held still: steady at power_W, as badly
/// cooled as its bounds allow, and in the coldest air as hot as it may become.
double hottest_pull_N(const ChannelSettings& channel, double power_W);

}  // namespace supercoil
