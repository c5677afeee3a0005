// How each fault is injected on the simulated board, and how soon it must be detected.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "loop/support/situations.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::test {

/// The deadline at any rate: a time that does not depend on the rate, plus a number of periods. The
/// time covers the detector's hold time, the board's filters and the muscle. The periods are 2, one
/// until a tick reads it and one for rounding to whole ticks; where a detector counts ticks, they
/// are its count plus one instead.
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
  std::string how = {};  ///< how it comes about, when that is not obvious
  Within within;         ///< from the injection to heater off, and to the board's fault
  std::vector<Situation> elsewhere = {};  ///< where it cannot come about,
  std::string why_not = {};               ///< and why
  std::function<void(Rig&)> inject;       ///< into the tested channel, or the whole board
  std::function<void(Rig&)> remove;
  std::function<void(RigSettings&)> tune = [](RigSettings&) {};  ///< thresholds for the test
  /// The first cause where another detector is just as right, and faster.
  std::function<Fault(Situation)> first = nullptr;
};

/// At least one of every fault but self_test_failed and those of a joint.
const std::vector<FaultCase>& fault_cases();

/// Whether the fault can occur in this situation.
bool possible(const FaultCase& fault_case, Situation situation);

}  // namespace supercoil::test
