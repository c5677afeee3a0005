// From where a study draws its values.
#pragma once

#include <cstddef>
#include <limits>

namespace supercoil::host_sim::campaign {

struct Distribution {
  enum class Kind { constant, uniform, log_uniform, normal, list };

  Kind kind = Kind::constant;
  double first = 0.0;   ///< the constant, the least value, or the mean
  double second = 0.0;  ///< the largest value, or the standard deviation
  /// A normal distribution is cut off at these, and what is left is drawn from.
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::size_t values = 0;  ///< of a list

  /// The quantile of probability, which is between 0 and 1, both excluded. Of a list: the value's
  /// index; each is as likely as the others.
  double at(double probability) const;
};

/// Of the standard normal distribution.
double normal_quantile(double probability);
double normal_probability(double quantile);

}  // namespace supercoil::host_sim::campaign
