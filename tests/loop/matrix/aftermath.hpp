// When a fault was seen and all is cold: what may come after it.
#pragma once

#include <string>

#include "loop/matrix/fault_case.hpp"

namespace supercoil::test {

/// The first cause is kept, only an edge resets, one is enough, and only when the cause is gone;
/// nothing heats again by itself. `first`: the cause of the tested channel; `neighbours`: that of
/// its neighbour, or none.
std::string aftermath(const FaultCase& fault_case, Rig& rig, Fault first, Fault neighbours);

}  // namespace supercoil::test
