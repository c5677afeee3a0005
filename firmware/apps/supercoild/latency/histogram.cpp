#include "apps/supercoild/latency/histogram.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::daemon {

namespace {

/// The next of 1, 2, 5, 10, 20, 50, …
std::size_t round_up(std::size_t number) {
  for (std::size_t decade = 1;; decade *= 10) {
    for (const std::size_t step : {decade, 2 * decade, 5 * decade}) {
      if (step >= number) return step;
    }
  }
}

}  // namespace

void Histogram::add(hal::Duration time) noexcept {
  time = std::max(time, hal::Duration{});
  ++bins_[std::min(static_cast<std::size_t>(time / width_), bins_.size() - 1)];
  ++count_;
  sum_ns_ += static_cast<double>(time.count());
  min_ = std::min(min_, time);
  max_ = std::max(max_, time);
}

double Histogram::mean_ns() const {
  return count_ == 0 ? 0.0 : sum_ns_ / static_cast<double>(count_);
}

hal::Duration Histogram::quantile(double fraction) const {
  const double wanted = fraction * static_cast<double>(count_);
  double counted = 0.0;
  // The last bin also counts times beyond its end.
  for (std::size_t i = 0; i + 1 < bins_.size(); ++i) {
    counted += static_cast<double>(bins_[i]);
    const hal::Duration end = static_cast<std::int64_t>(i + 1) * width_;
    if (counted >= wanted && counted > 0.0) return std::min(end, max_);
  }
  return max_;
}

std::vector<Bar> bars(const Histogram& histogram) {
  constexpr std::size_t max_bars = 20;
  constexpr double tail_begins = 0.99;
  const auto bin_of = [&](hal::Duration time) {
    return std::min(static_cast<std::size_t>(time / histogram.width()),
                    histogram.bins().size() - 1);
  };
  std::vector<Bar> all;
  if (histogram.count() == 0) return all;
  const std::size_t last = bin_of(histogram.max());
  const std::size_t tail = bin_of(histogram.quantile(tail_begins));
  std::size_t wide = round_up((tail - bin_of(histogram.min())) / max_bars + 1);
  std::size_t from = bin_of(histogram.min()) / wide * wide;
  while (from <= last) {
    const std::size_t to = std::min(from + wide, histogram.bins().size());
    Bar bar{static_cast<std::int64_t>(from) * histogram.width(),
            static_cast<std::int64_t>(to) * histogram.width(), 0};
    for (std::size_t i = from; i < to; ++i)
      bar.count += histogram.bins()[i];
    if (to == histogram.bins().size()) bar.to = std::max(bar.to, histogram.max());
    if (bar.count > 0) all.push_back(bar);
    if (to > tail) wide *= 2;
    from = to;
  }
  return all;
}

}  // namespace supercoil::daemon
