// Is everybody still at work: the loop, the threads, whoever commands?
#pragma once

#include <cstdint>

#include "supervisor/detectors/margin.hpp"

namespace supercoil::detectors {

/// Trips at `most` events in a row (periods left out; damaged commands).
class InARow {
 public:
  explicit InARow(int most) : most_(most) {}

  bool step(bool happened) { return step(happened ? 1L : 0L); }
  /// Several at once; none ends the row.
  bool step(long happened) {
    count_ = happened > 0 ? count_ + happened : 0;
    margin_ = rising(static_cast<double>(count_), static_cast<double>(most_));
    return count_ >= most_;
  }
  const Margin& margin() const { return margin_; }

 private:
  int most_;
  long count_ = 0;
  Margin margin_;
};

/// Trips when a counter that its owner turns has stood still for max_s (a thread's sign of life).
class Silent {
 public:
  Silent(double max_s, double step_s) : max_s_(max_s), held_(max_s, step_s) {}

  bool step(std::uint32_t counter) {
    const bool trips = held_.step(counter == last_);
    last_ = counter;
    margin_ = rising(held_.held_s(), max_s_);
    return trips;
  }
  const Margin& margin() const { return margin_; }

 private:
  double max_s_;
  HeldFor held_;
  std::uint32_t last_ = 0;
  Margin margin_;
};

/// Every command to heat expires unless it is renewed: trips when it is older than max_s while it
/// holds.
class Expired {
 public:
  Expired(double max_s, double step_s) : max_s_(max_s), step_s_(step_s) {}

  /// renewed: a valid command arrived since the last tick. heating: a command to heat is in force.
  bool step(bool renewed, bool heating) {
    age_s_ = renewed || !heating ? 0.0 : age_s_ + step_s_;
    margin_ = rising(age_s_, max_s_);
    return age_s_ > max_s_ + 0.5 * step_s_;
  }
  const Margin& margin() const { return margin_; }

 private:
  double max_s_;
  double step_s_;
  double age_s_ = 0.0;
  Margin margin_;
};

}  // namespace supercoil::detectors
