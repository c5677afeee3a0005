// How each fault is brought about on the simulated board, and how soon it must be seen.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "loop/support/situations.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::test {

struct FaultCase {
  Fault fault;
  double within_s;                   ///< from the injection to heater off
  std::vector<Situation> elsewhere;  ///< where it cannot come about,
  std::string why_not;               ///< and why
  std::function<void(Rig&)> inject;
  std::function<void(Rig&)> remove;
  std::function<void(RigSettings&)> tune = [](RigSettings&) {};  ///< thresholds for the test
  bool can_be_reset = true;
  /// Where another detector is as right and faster: the first cause is then this one.
  std::function<Fault(Situation)> first = nullptr;
};

const std::vector<FaultCase>& fault_cases();

}  // namespace supercoil::test
