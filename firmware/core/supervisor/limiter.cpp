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
  Result result{demanded_W, LimitedBy::nothing};
  const auto cap = [&](double cap_W, LimitedBy by) {
    if (result.power_W > cap_W) result = {cap_W, by};
  };
  if (!std::isfinite(demanded_W) || std::isnan(temperature_C)) {
    result = {0.0, LimitedBy::invalid};
  } else {
    if (demanded_W < settings_.min_W) result = {settings_.min_W, LimitedBy::minimum};
    cap(max_W(), LimitedBy::maximum);
    cap(max_W(temperature_C), LimitedBy::temperature);
    cap(unproven_W_, LimitedBy::unproven);
    cap(last_W_ + rise_W_, LimitedBy::slew);
  }
  last_W_ = result.power_W;
  return result;
}

}  // namespace supercoil
