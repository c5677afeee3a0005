// How each fault is brought about on the simulated board, and how soon it must be seen.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "loop/support/situations.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::test {

/// The rule for every rate: a time that does not depend on it, and so many periods. The time is how
/// long the detector holds, and what the board's filters and the muscle need. The periods are 2,
/// one until a tick reads it and one for the rounding to whole ticks; or, where a detector counts
/// ticks instead, what it counts and one.
struct Within {
  double time_s;
  int periods = 2;
  double at(double period_s) const { return time_s + periods * period_s; }
};

inline std::string text(Fault fault) {
  return std::string(name(fault));
}

struct FaultCase {
  Fault fault;
  std::string how = {};  ///< it comes about, when that is not the obvious way
  Within within;         ///< from the injection to heater off, and to the board's fault
  std::vector<Situation> elsewhere = {};  ///< where it cannot come about,
  std::string why_not = {};               ///< and why
  std::function<void(Rig&)> inject;       ///< into the tested channel, or the whole board
  std::function<void(Rig&)> remove;
  std::function<void(RigSettings&)> tune = [](RigSettings&) {};  ///< thresholds for the test
  /// Where another detector is as right and faster: the first cause is then this one.
  std::function<Fault(Situation)> first = nullptr;
};

/// At least one of every fault but self_test_failed and those of a joint.
const std::vector<FaultCase>& fault_cases();

/// Whether the fault can come about there.
bool possible(const FaultCase& fault_case, Situation situation);

}  // namespace supercoil::test
