// A histogram of measured times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "supercoil/hal/clock.hpp"

namespace supercoil::daemon {

/// Times in bins of equal width. All memory is allocated in the constructor.
class Histogram {
 public:
  /// Bin i counts times from i·width up to, but excluding, (i+1)·width; the last bin also counts
  /// everything beyond it. width: above 0; bins: at least 1.
  Histogram(hal::Duration width, std::size_t bins) : width_(width), bins_(bins) {}

  /// A negative time counts as 0.
  void add(hal::Duration time) noexcept;

  hal::Duration width() const { return width_; }
  const std::vector<std::uint64_t>& bins() const { return bins_; }
  std::uint64_t count() const { return count_; }
  /// Exact, not rounded to bins; 0 when nothing was added.
  hal::Duration min() const { return count_ == 0 ? hal::Duration{} : min_; }
  hal::Duration max() const { return max_; }
  double mean_ns() const;
  /// At least `share` (0 to 1) of the times are at most this: the end of a bin, but never more than
  /// the longest time.
  hal::Duration quantile(double fraction) const;

 private:
  hal::Duration width_;
  std::vector<std::uint64_t> bins_;
  std::uint64_t count_ = 0;
  double sum_ns_ = 0.0;
  hal::Duration min_ = hal::Duration::max();
  hal::Duration max_{};
};

/// Several bins combined.
struct Bar {
  hal::Duration from{};
  hal::Duration to{};
  std::uint64_t count = 0;
};

/// For display: at most 20 bars of one width, a round number, up to the 99th percentile, and
/// increasingly wider ones beyond it. Empty bars are omitted.
std::vector<Bar> bars(const Histogram& histogram);

}  // namespace supercoil::daemon
