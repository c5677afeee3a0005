// One fault on a board whose two channels are a joint.
#pragma once

#include <string>

#include "loop/matrix/trial.hpp"

namespace supercoil::test {

/// What went wrong; empty: nothing. situation: that of a single channel that is like what both do.
std::string try_joint(const FaultCase& fault_case, Situation situation);

}  // namespace supercoil::test
