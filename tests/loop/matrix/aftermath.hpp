// What may follow once a fault was detected and everything is cold.
#pragma once

#include <string>

#include "loop/matrix/fault_case.hpp"

namespace supercoil::test {

/// The first cause is kept; one edge resets, nothing else does, and only once the cause is gone;
/// nothing heats again by itself. `first`: the cause of the tested channel; `neighbours`: that of
/// its neighbour, or none.
std::string aftermath(const FaultCase& fault_case, Rig& rig, Fault first, Fault neighbours);

}  // namespace supercoil::test
