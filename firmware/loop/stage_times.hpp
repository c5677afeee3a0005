// How long each stage of a tick takes: always on, published.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <numeric>

#include "supercoil/hal/clock.hpp"

namespace supercoil {

/// Last, mean, largest, and a histogram with one bin for each power of two of nanoseconds.
class StageTime {
 public:
  static constexpr std::size_t bins = 32;

  void add(hal::Duration taken) {
    const auto nanoseconds = static_cast<std::uint64_t>(taken.count() < 0 ? 0 : taken.count());
    last_ = taken;
    if (taken > largest_) largest_ = taken;
    sum_ns_ += nanoseconds;
    const auto bin = static_cast<std::size_t>(std::bit_width(nanoseconds));
    ++histogram_[bin < bins ? bin : bins - 1];
  }

  hal::Duration last() const { return last_; }
  hal::Duration largest() const { return largest_; }
  double mean_ns() const {
    const std::uint64_t times = count();
    return times == 0 ? 0.0 : static_cast<double>(sum_ns_) / static_cast<double>(times);
  }
  std::uint64_t count() const {
    return std::accumulate(histogram_.begin(), histogram_.end(), std::uint64_t{0});
  }
  /// Bin i holds times from 2^(i−1) to 2^i − 1 ns; bin 0 holds 0; the last one all that is longer.
  const std::array<std::uint64_t, bins>& histogram() const { return histogram_; }

 private:
  hal::Duration last_{};
  hal::Duration largest_{};
  std::uint64_t sum_ns_ = 0;
  std::array<std::uint64_t, bins> histogram_{};
};

}  // namespace supercoil
