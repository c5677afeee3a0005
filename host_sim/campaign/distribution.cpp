#include "campaign/distribution.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/normal.hpp>

namespace supercoil::host_sim::campaign {

double normal_quantile(double probability) {
  return boost::math::quantile(boost::math::normal(), probability);
}

double normal_probability(double quantile) {
  return boost::math::cdf(boost::math::normal(), quantile);
}

namespace {

double cut_normal(const Distribution& d, double probability) {
  // A probability near 1 has fewer digits than one near 0: the upper tail is drawn as the lower
  // one.
  if (d.min > d.first) {
    const Distribution mirrored{d.kind, -d.first, d.second, -d.max, -d.min, 0};
    return -cut_normal(mirrored, 1.0 - probability);
  }
  const auto below = [&](double value) {
    return std::isfinite(value) ? normal_probability((value - d.first) / d.second)
                                : (value > 0.0 ? 1.0 : 0.0);
  };
  const double low = below(d.min);
  const double target = low + probability * (below(d.max) - low);
  // Rounding may turn a probability in a far tail into 0 or 1.
  constexpr double min = std::numeric_limits<double>::min();
  constexpr double max = 1.0 - std::numeric_limits<double>::epsilon() / 2.0;
  const double value = d.first + d.second * normal_quantile(std::clamp(target, min, max));
  return std::clamp(value, d.min, d.max);
}

}  // namespace

double Distribution::at(double probability) const {
  switch (kind) {
    case Kind::uniform:
      return first + probability * (second - first);
    case Kind::log_uniform:
      return std::exp(std::lerp(std::log(first), std::log(second), probability));
    case Kind::normal:
      return cut_normal(*this, probability);
    case Kind::list:
      // A correlated probability may round to 1.
      return std::min(std::floor(probability * static_cast<double>(values)),
                      static_cast<double>(values) - 1.0);
    case Kind::constant:
      break;
  }
  return first;
}

}  // namespace supercoil::host_sim::campaign
