// One fault on a board whose two channels are a joint.
#pragma once

#include <string>

#include "loop/matrix/trial.hpp"

namespace supercoil::test {

/// What was not as it must be; empty: nothing. situation: of a single channel, like that of both.
std::string try_joint(const FaultCase& fault_case, Situation situation);

}  // namespace supercoil::test
