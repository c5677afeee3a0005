// Failure rates with their confidence, quantiles and rank correlation.
#pragma once

#include <cstdint>
#include <vector>

namespace supercoil::host_sim::campaign {

/// A share of runs with its exact 95 % confidence interval (Clopper and Pearson, 1934).
struct Rate {
  std::int64_t failures = 0;
  std::int64_t runs = 0;
  double low = 0.0;
  double high = 1.0;

  double rate() const {
    return runs > 0 ? static_cast<double>(failures) / static_cast<double>(runs) : 0.0;
  }
  double half_width() const { return (high - low) / 2.0; }
};
/// 0 <= failures <= runs
Rate rate_of(std::int64_t failures, std::int64_t runs);

/// The value below which this share of the values lies, by nearest rank; NaN if there are none.
/// Values must not be NaN, but may be infinite.
double quantile(std::vector<double> values, double share);

/// Spearman's rank correlation, from -1 to 1; equal values share their ranks. NaN if x or y is
/// constant. Values must not be NaN, but may be infinite. x and y have the same length.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace supercoil::host_sim::campaign
