#include "supervisor/limiter.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil {

double Limiter::max_W(double temperature_C) const {
  if (temperature_C <= settings_.derate_from_C) return max_W();
  const double span_C = settings_.derate_to_C - settings_.derate_from_C;
  return max_W() * std::max(0.0, (settings_.derate_to_C - temperature_C) / span_C);
}

Limiter::Result Limiter::step(double demanded_W, double temperature_C) {
  // Two variables: copying a pair at each limit would stall.
  double power_W = demanded_W;
  LimitedBy by = LimitedBy::nothing;
  const auto hold_at = [&](double limit_W, LimitedBy limit) {
    power_W = limit_W;
    by = limit;
  };
  const auto cap = [&](double cap_W, LimitedBy limit) {
    if (power_W > cap_W) hold_at(cap_W, limit);
  };
  if (!std::isfinite(demanded_W) || std::isnan(temperature_C)) {
    hold_at(0.0, LimitedBy::invalid);
  } else {
    if (demanded_W < settings_.min_W) hold_at(settings_.min_W, LimitedBy::minimum);
    cap(max_W(), LimitedBy::maximum);
    cap(max_W(temperature_C), LimitedBy::temperature);
    cap(unproven_W_, LimitedBy::unproven);
    cap(last_W_ + rise_W_, LimitedBy::slew);
  }
  last_W_ = power_W;
  return {power_W, by};
}

}  // namespace supercoil
