// The table of a scenario that says what the true muscle is.
#pragma once

#include "config/section.hpp"
#include "scenario/conditions.hpp"

namespace supercoil::host_sim {

/// Finishes the section.
PlantSettings read_plant(config::Section section);

/// Its physical parameters alone. Does not finish the section.
control::PhysicalParameters read_plant_parameters(config::Section& section);

}  // namespace supercoil::host_sim
