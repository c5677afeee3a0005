// Statistics of one measure over several seeds.
#pragma once

#include <cstdint>
#include <vector>

namespace supercoil::host_sim::compare {

struct Statistics {
  std::int64_t runs = 0;
  double mean = 0.0;
  /// 95 % confidence interval of the mean: mean ± this, by Student's t with runs − 1 degrees of
  /// freedom. NaN for a single run or where a value is infinite.
  double half_width = 0.0;
  double worst = 0.0;  ///< the largest
};

/// values: at least one, none NaN.
Statistics statistics_of(const std::vector<double>& values);

}  // namespace supercoil::host_sim::compare
