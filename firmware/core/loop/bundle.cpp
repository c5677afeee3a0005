#include "loop/bundle.hpp"

#include <algorithm>
#include <utility>

namespace supercoil {

namespace {

control::PowerRange within_both(const control::PowerRange& a, const control::PowerRange& b) {
  return {std::max(a.min_W, b.min_W), std::min(a.max_W, b.max_W)};
}

WholeBundle alone(const Heater& heater) {
  return {heater.power_range(), heater.limiter().max_W(),
          heater.limiter().max_W(heater.heat().hottest_C()),
          heater.power_bounds().true_over_measured().max, heater.heat().hottest_K()};
}

}  // namespace

Bundle::Bundle(Axis& leader, std::vector<Axis*> followers)
    : leader_(leader), followers_(std::move(followers)) {}

void Bundle::observe() {
  for (Axis* const follower : followers_)
    follower->follow_knowledge(leader_);
  WholeBundle whole = alone(leader_.heater());
  for (const Axis* const follower : followers_) {
    const WholeBundle one = alone(follower->heater());
    whole.range = within_both(whole.range, one.range);
    whole.max_W = std::min(whole.max_W, one.max_W);
    whole.max_hot_W = std::min(whole.max_hot_W, one.max_hot_W);
    whole.max_power_ratio = std::max(whole.max_power_ratio, one.max_power_ratio);
    whole.hottest_K = std::max(whole.hottest_K, one.hottest_K);
    if (whole.limited_by == LimitedBy::nothing && is_led(follower->mode()))
      whole.limited_by = follower->heater().allowed().by;
  }
  leader_.lead(whole);
}

void Bundle::limit() {
  const double demanded_W = leader_.demanded_W();
  control::PowerRange range = leader_.allowed_range();
  for (const Axis* const follower : followers_) {
    if (is_led(follower->mode())) range = within_both(range, follower->allowed_range());
  }
  // The weakest gets the whole demand, so that its limiter says why the others get no more either.
  // During a dither all follow the leader's power instead.
  const auto is_cut_by = [&](const Axis& axis) {
    return !leader_.dithers() && demanded_W > range.max_W &&
           axis.allowed_range().max_W <= range.max_W;
  };
  leader_.limit(is_cut_by(leader_) ? demanded_W : std::min(demanded_W, range.max_W), range.max_W);
  const double leader_W = leader_.heater().allowed().power_W;
  for (Axis* const follower : followers_) {
    if (!is_led(follower->mode())) {
      follower->follow_power(0.0, 0.0);
    } else {
      follower->follow_power(demanded_W, is_cut_by(*follower) ? demanded_W : leader_W);
    }
  }
}

}  // namespace supercoil
