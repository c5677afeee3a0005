// What a fault of the tested channel does to its neighbour: nothing, or the same fault.
#pragma once

#include <string>

#include "loop/support/rig.hpp"

namespace supercoil::test {

/// What is wrong with the neighbour at this tick. With Fault::none it must go on as if nothing had
/// happened: active, without fault, and where its reference model is. Otherwise it must be in
/// fault, with this cause.
std::string neighbour_wrong(const Rig& rig, Fault cause);

}  // namespace supercoil::test
