// The table of a scenario that says where the muscle should be.
#pragma once

#include "config/section.hpp"
#include "scenario/reference.hpp"

namespace supercoil::host_sim {

Reference read_reference(config::Section& section);

}  // namespace supercoil::host_sim
