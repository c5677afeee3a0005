// The built-in controllers and disturbances, in the order of the tables.
#pragma once

#include <vector>

#include "scenario/builtin.hpp"

namespace supercoil::host_sim::compare {

/// Scenarios of only [controller] and [estimator].
const std::vector<BuiltinScenario>& controllers();
/// Scenarios without these.
const std::vector<BuiltinScenario>& disturbances();

}  // namespace supercoil::host_sim::compare
