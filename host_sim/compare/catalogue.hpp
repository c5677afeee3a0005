// What comes with the program to compare, in the order in which tables have it.
#pragma once

#include <vector>

#include "scenario/builtin.hpp"

namespace supercoil::host_sim::compare {

/// Scenarios of only [controller] and [estimator].
const std::vector<BuiltinScenario>& controllers();
/// Scenarios without these.
const std::vector<BuiltinScenario>& disturbances();

}  // namespace supercoil::host_sim::compare
