// How often, how certain, and what decides.
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

/// The value below which this share of them is, by the nearest rank; NaN of none. None may be NaN,
/// any may be infinite.
double quantile(std::vector<double> values, double share);

/// Spearman's: of the ranks of both, from -1 to 1; equal values share their ranks. NaN where one of
/// both is always the same. None may be NaN, any may be infinite. As many of both.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace supercoil::host_sim::campaign
