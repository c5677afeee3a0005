// The tables of a scenario, one by one.
#pragma once

#include <toml++/toml.h>

#include "config/diagnostics.hpp"
#include "config/section.hpp"
#include "scenario/conditions.hpp"
#include "scenario/reference.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// Finishes the section.
PlantSettings read_plant(config::Section section);

/// Its physical parameters alone. Does not finish the section.
control::PhysicalParameters read_plant_parameters(config::Section& section);

Reference read_reference(config::Section& section);

/// [muscle], what the board believes; each key that is absent is as in [plant].
control::PhysicalParameters read_muscle(const toml::table& document,
                                        config::Diagnostics& diagnostics);

/// Every other table than [simulation] and [[event]], and the keys that no table has.
Conditions read_conditions(const toml::table& document, const control::PhysicalParameters& believed,
                           double step_s, config::Diagnostics& diagnostics);

}  // namespace supercoil::host_sim
