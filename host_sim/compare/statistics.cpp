#include "compare/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <boost/math/distributions/students_t.hpp>

namespace supercoil::host_sim::compare {

Statistics statistics_of(const std::vector<double>& values) {
  Statistics s;
  s.runs = static_cast<std::int64_t>(values.size());
  const auto count = static_cast<double>(values.size());
  for (const double value : values)
    s.mean += value / count;
  s.worst = *std::max_element(values.begin(), values.end());
  s.half_width = NAN;
  if (values.size() < 2 || !std::isfinite(s.mean)) return s;
  double squares = 0.0;
  for (const double value : values)
    squares += (value - s.mean) * (value - s.mean);
  constexpr double upper_tail = 0.025;
  const double quantile = boost::math::quantile(
      boost::math::complement(boost::math::students_t(count - 1.0), upper_tail));
  s.half_width = quantile * std::sqrt(squares / (count - 1.0) / count);
  return s;
}

}  // namespace supercoil::host_sim::compare
