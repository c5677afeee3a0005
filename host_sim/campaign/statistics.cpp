#include "campaign/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <boost/math/distributions/binomial.hpp>

namespace supercoil::host_sim::campaign {

namespace {

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && values[order[end]] == values[order[first]])
      ++end;
    const double shared = static_cast<double>(first + end - 1) / 2.0;
    for (; first < end; ++first)
      ranks[order[first]] = shared;
  }
  return ranks;
}

}  // namespace

Rate rate_of(std::int64_t failures, std::int64_t runs) {
  using Binomial = boost::math::binomial_distribution<double>;
  constexpr double tail = 0.025;
  Rate rate{failures, runs, 0.0, 1.0};
  if (runs == 0) return rate;
  const auto of = static_cast<double>(runs);
  const auto k = static_cast<double>(failures);
  if (failures > 0) rate.low = Binomial::find_lower_bound_on_p(of, k, tail);
  if (failures < runs) rate.high = Binomial::find_upper_bound_on_p(of, k, tail);
  return rate;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  std::ranges::sort(values);
  const auto rank = std::ceil(share * static_cast<double>(values.size())) - 1.0;
  return values[static_cast<std::size_t>(std::max(0.0, rank))];
}

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto of_x = ranks(x);
  const auto of_y = ranks(y);
  const double middle = (static_cast<double>(x.size()) - 1.0) / 2.0;
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < of_x.size(); ++i) {
    const double dx = of_x[i] - middle;
    const double dy = of_y[i] - middle;
    xx += dx * dx;
    yy += dy * dy;
    xy += dx * dy;
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : NAN;
}

}  // namespace supercoil::host_sim::campaign
