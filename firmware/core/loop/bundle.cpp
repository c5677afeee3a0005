#include "loop/bundle.hpp"

#include <algorithm>
#include <utility>

namespace supercoil {

namespace {

control::PowerRange within_both(const control::PowerRange& a, const control::PowerRange& b) {
  return {std::max(a.min_W, b.min_W), std::min(a.max_W, b.max_W)};
}

}  // namespace

Bundle::Bundle(Axis& leader, std::vector<Axis*> followers)
    : leader_(leader), followers_(std::move(followers)) {}

void Bundle::observe() {
  Companions others{leader_.heater().power_range(), leader_.heater().limiter().max_W(),
                    leader_.heater().limiter().max_W(leader_.heater().heat().hottest_C())};
  for (Axis* const follower : followers_) {
    follower->follow_knowledge(leader_);
    const Heater& heater = follower->heater();
    others.range = within_both(others.range, heater.power_range());
    others.max_W = std::min(others.max_W, heater.limiter().max_W());
    others.max_hot_W =
        std::min(others.max_hot_W, heater.limiter().max_W(heater.heat().hottest_C()));
    others.max_power_ratio =
        std::max(others.max_power_ratio, heater.power_bounds().true_over_measured().max);
    others.hottest_K = std::max(others.hottest_K, heater.heat().hottest_K());
    if (others.limited_by == LimitedBy::nothing && is_led(follower->mode()))
      others.limited_by = heater.allowed().by;
  }
  leader_.lead(others);
}

void Bundle::limit() {
  const double demanded_W = leader_.demanded_W();
  control::PowerRange range = leader_.allowed_range();
  for (const Axis* const follower : followers_) {
    if (is_led(follower->mode())) range = within_both(range, follower->allowed_range());
  }
  // The weakest is asked for all, so that its limiter says why the others get no more either.
  // While there is a dither all follow that instead.
  const auto is_cut_by = [&](const Axis& axis) {
    return !leader_.dithers() && demanded_W > range.max_W &&
           axis.allowed_range().max_W <= range.max_W;
  };
  leader_.limit(is_cut_by(leader_) ? demanded_W : std::min(demanded_W, range.max_W), range.max_W);
  const double leaders_W = leader_.heater().allowed().power_W;
  for (Axis* const follower : followers_) {
    if (!is_led(follower->mode())) {
      follower->follow_power(0.0, 0.0);
    } else {
      follower->follow_power(demanded_W, is_cut_by(*follower) ? demanded_W : leaders_W);
    }
  }
}

}  // namespace supercoil
