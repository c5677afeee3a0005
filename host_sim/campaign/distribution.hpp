// Distributions from which a study draws its values.
#pragma once

#include <cstddef>
#include <limits>

namespace supercoil::host_sim::campaign {

struct Distribution {
  enum class Kind { constant, uniform, log_uniform, normal, list };

  Kind kind = Kind::constant;
  double first = 0.0;   ///< the constant, the minimum, or the mean
  double second = 0.0;  ///< the maximum, or the standard deviation
  /// A normal distribution is truncated at these limits.
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::size_t values = 0;  ///< in a list

  /// The quantile of a probability between 0 and 1, both excluded. For a list: the value's index;
  /// all values are equally likely.
  double at(double probability) const;
};

/// For the standard normal distribution.
double normal_quantile(double probability);
double normal_probability(double quantile);

}  // namespace supercoil::host_sim::campaign
