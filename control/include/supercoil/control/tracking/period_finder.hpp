// Whether a reference repeats itself, and with which period.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace supercoil::control {

/// Remembers the reference as 1024 samples, twice as coarse whenever they are full, and the last
/// times at which it rose through the middle of its range. The time between two such rises is the
/// period if the reference was the same for that long before each: to a hundredth of its range, a
/// sample earlier or later. A few samples are compared each tick. Once a period is found each new
/// sample is compared, and the first ones that differ end the period.
class PeriodFinder {
 public:
  static constexpr double min_period_s = 2.0;
  static constexpr double max_period_s = 600.0;

  /// step_s: > 0, between ticks.
  explicit PeriodFinder(double step_s) : step_s_(step_s) { restart(); }

  void restart() {
    period_s_ = 0.0;
    ticks_ = 0;
    sample_ticks_ = std::max<std::int64_t>(1, std::llround(first_sample_s / step_s_));
    count_ = 0;
    rises_ = 0;
    candidate_ = 0;
    armed_ = false;
    wrong_ = 0;
  }

  /// One tick of the reference, in any unit.
  void step(double reference) {
    if (ticks_ % sample_ticks_ == 0) remember(static_cast<float>(reference));
    look_for_rise(reference);
    if (candidate_ > 0) compare_some();
    last_ = reference;
    ++ticks_;
  }

  /// 0 when none is known.
  double period_s() const { return period_s_; }

 private:
  static constexpr std::size_t samples = 1024;
  static constexpr std::size_t times = 16;
  static constexpr double first_sample_s = 0.016;
  static constexpr int compared_per_tick = 8;
  static constexpr std::int64_t min_samples = 32;  ///< in a period
  static constexpr float tolerance = 0.01F;        ///< of the range
  static constexpr int max_wrong = 3;              ///< samples in a row

  double sample_s() const { return static_cast<double>(sample_ticks_) * step_s_; }
  float range() const { return max_ - min_; }

  void remember(float value) {
    // A period fits in half of the samples: once it is known, the oldest samples may go.
    if (period_s_ == 0.0 && count_ == samples) halve();
    if (ticks_ % sample_ticks_ != 0) return;
    if (count_ == 0) min_ = max_ = value;
    min_ = std::min(min_, value);
    max_ = std::max(max_, value);
    history_[static_cast<std::size_t>(count_++) % samples] = value;
    if (period_s_ > 0.0) follow();
  }

  void halve() {
    for (std::size_t i = 0; i < samples / 2; ++i)
      history_[i] = history_[2 * i];
    count_ = samples / 2;
    sample_ticks_ *= 2;
    candidate_ = 0;
    if (sample_s() * samples > 4.0 * max_period_s) restart();
  }

  void look_for_rise(double reference) {
    const double middle = 0.5 * (static_cast<double>(min_) + static_cast<double>(max_));
    const double margin = 0.1 * static_cast<double>(range());
    if (reference < middle - margin) armed_ = true;
    if (!armed_ || !(reference >= middle) || margin == 0.0) return;
    armed_ = false;
    const double part = (middle - last_) / (reference - last_);
    const double now_s = (static_cast<double>(ticks_ - 1) + std::clamp(part, 0.0, 1.0)) * step_s_;
    for (std::size_t i = times - 1; i > 0; --i)
      rise_s_[i] = rise_s_[i - 1];
    rise_s_[0] = now_s;
    rises_ = std::min<std::int64_t>(rises_ + 1, times);
    if (period_s_ == 0.0) propose(1);
  }

  /// Proposes the time since the rise that was `back` before the last one, or since an earlier one.
  void propose(std::int64_t back) {
    for (candidate_ = 0; back < rises_; ++back) {
      const double time_s = rise_s_[0] - rise_s_[static_cast<std::size_t>(back)];
      if (time_s < min_period_s || time_s > max_period_s) continue;
      lag_ = time_s / sample_s();
      compared_ = count_ - 1;
      compared_to_ = compared_ - static_cast<std::int64_t>(lag_);
      if (lag_ < min_samples || static_cast<double>(compared_to_) - lag_ < 2.0) continue;
      candidate_ = back;
      return;
    }
  }

  void compare_some() {
    for (int i = 0; i < compared_per_tick; ++i, --compared_) {
      if (compared_ < compared_to_) {
        period_s_ = rise_s_[0] - rise_s_[static_cast<std::size_t>(candidate_)];
        candidate_ = 0;
        wrong_ = 0;
        return;
      }
      if (!alike(compared_)) {
        propose(candidate_ + 1);
        return;
      }
    }
  }

  /// True when the sample lies within those of one period before.
  bool alike(std::int64_t sample) const {
    const double before = static_cast<double>(sample) - lag_;
    const auto left = static_cast<std::int64_t>(std::floor(before));
    float low = at(left - 1);
    float high = low;
    for (std::int64_t i = left; i <= left + 2; ++i) {
      low = std::min(low, at(i));
      high = std::max(high, at(i));
    }
    const float value = at(sample);
    const float room = tolerance * range();
    return value >= low - room && value <= high + room;
  }
  float at(std::int64_t sample) const {
    return history_[static_cast<std::size_t>(sample) % samples];
  }

  void follow() {
    wrong_ = alike(count_ - 1) ? 0 : wrong_ + 1;
    if (wrong_ >= max_wrong) restart();
  }

  double step_s_;
  double period_s_ = 0.0;
  double last_ = 0.0;
  std::int64_t ticks_ = 0;
  std::int64_t sample_ticks_ = 1;
  std::int64_t count_ = 0;  ///< of samples
  float min_ = 0.0F;
  float max_ = 0.0F;
  bool armed_ = false;  ///< the reference was well below the middle
  std::int64_t rises_ = 0;
  std::array<double, times> rise_s_{};  ///< the last one first
  std::int64_t candidate_ = 0;          ///< rises back; 0: none
  double lag_ = 0.0;                    ///< of the candidate or the period, in samples
  std::int64_t compared_ = 0;           ///< sample
  std::int64_t compared_to_ = 0;
  int wrong_ = 0;
  std::array<float, samples> history_{};
};

}  // namespace supercoil::control
