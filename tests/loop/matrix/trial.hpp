// One fault in one situation: everything that must then hold.
#pragma once

#include <string>

#include "loop/matrix/fault_case.hpp"

namespace supercoil::test {

/// Empty when all held; else what did not.
std::string try_fault(const FaultCase& fault_case, Situation situation, double* seen_after_s);

/// The self-test's two ways to fail, at boot.
std::string try_self_test(double* seen_after_s);

}  // namespace supercoil::test
