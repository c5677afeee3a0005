// A recording at a constant rate.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace supercoil::identification {

/// A span of time, ends included.
struct Span {
  double from_s;
  double to_s;

  bool holds(double time_s) const { return time_s >= from_s && time_s <= to_s; }
};

/// position_m[k] was measured at start_s + k·step_s and is NaN where nothing was; power_W[k] acted
/// from then until the next sample.
struct Samples {
  double start_s = 0.0;
  double step_s = 0.01;
  std::vector<double> position_m;
  std::vector<double> power_W;

  std::size_t size() const { return position_m.size(); }
  double time_s(std::size_t k) const { return start_s + static_cast<double>(k) * step_s; }
  double end_s() const { return time_s(size() - 1); }
  bool measured(std::size_t k) const { return !std::isnan(position_m[k]); }
};

}  // namespace supercoil::identification
