// One fault in one situation: everything that must then hold.
#pragma once

#include <string>

#include "loop/matrix/fault_case.hpp"

namespace supercoil::test {

/// The board on which a case is tried, with the thresholds that it needs.
RigSettings board_for(const FaultCase& fault_case, double rate_Hz = 1000.0);

/// What did not hold; empty when everything did.
std::string try_fault(const FaultCase& fault_case, Situation situation, const RigSettings& settings,
                      double* seen_after_s);

/// The self-test's two ways to fail, at boot.
std::string try_self_test(const RigSettings& settings, double* seen_after_s);

}  // namespace supercoil::test
