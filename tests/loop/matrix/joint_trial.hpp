// One fault on a board whose two channels are a joint.
#pragma once

#include <string>

#include "loop/matrix/trial.hpp"

namespace supercoil::test {

/// What went wrong; empty: nothing. situation: the single channel's that is like that of both.
std::string try_joint(const FaultCase& fault_case, Situation situation);

}  // namespace supercoil::test
