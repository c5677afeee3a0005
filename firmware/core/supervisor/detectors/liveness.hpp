// Liveness of the loop, the threads and the master.
#pragma once

#include <cstdint>

#include "supervisor/detectors/limits.hpp"

namespace supercoil::detectors {

/// Trips at `most` events in a row (periods left out; damaged commands).
class ConsecutiveCount final : public Detector {
 public:
  explicit ConsecutiveCount(int max_count) : max_count_(max_count) {}

  bool step(bool happened) { return step(std::int64_t{happened}); }
  /// Several events at once; 0 ends the row.
  bool step(std::int64_t happened) {
    count_ = happened > 0 ? count_ + happened : 0;
    return count_ >= max_count_;
  }
  Margin margin() const override {
    return rising(static_cast<double>(count_), static_cast<double>(max_count_));
  }

 private:
  int max_count_;
  std::int64_t count_ = 0;
};

/// Trips when a counter that its owner advances stands still for max_s (a thread's sign of life).
class StalledCounter final : public Detector {
 public:
  StalledCounter(double max_s, double step_s) : still_(max_s, step_s) {}

  bool step(std::uint32_t counter) {
    const bool still = counter == last_;
    last_ = counter;
    return still_.step(still);
  }
  Margin margin() const override { return still_.margin(); }

 private:
  TimedFlag still_;
  std::uint32_t last_ = 0;
};

/// Every command to heat expires unless renewed: trips when the one in force is older than max_s.
class CommandTimeout final : public Detector {
 public:
  CommandTimeout(double max_s, double step_s) : max_s_(max_s), step_s_(step_s) {}

  /// renewed: a valid command arrived since the last tick. heating: a command to heat is in force.
  bool step(bool renewed, bool heating) {
    age_s_ = renewed || !heating ? 0.0 : age_s_ + step_s_;
    return age_s_ > max_s_ + 0.5 * step_s_;
  }
  Margin margin() const override { return rising(age_s_, max_s_); }

 private:
  double max_s_;
  double step_s_;
  double age_s_ = 0.0;
};

/// Trips when the controller's demand is not finite, or has exceeded the applied power for max_s
/// without a gap: the controller is lost.
class ControllerSaturated final : public Detector {
 public:
  ControllerSaturated(double max_s, double step_s) : unmet_(max_s, step_s) {}

  /// unmet_demand: the controller demanded more than it got since the last tick.
  bool step(double demanded_W, bool unmet_demand) {
    demanded_W_ = demanded_W;
    const bool lost = unmet_.step(unmet_demand);
    return !std::isfinite(demanded_W) || lost;
  }
  void reset() { unmet_.reset(); }
  Margin margin() const override {
    return std::isfinite(demanded_W_) ? unmet_.margin() : rising(demanded_W_, 1.0);
  }

 private:
  TimedFlag unmet_;
  double demanded_W_ = 0.0;
};

}  // namespace supercoil::detectors
