// The tables of a scenario, one by one.
#pragma once

#include <optional>

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

/// of_joint: its defaults go to both sides of zero.
Reference read_reference(config::Section& section, bool of_joint);

/// [joint] but for its co-contraction; empty: there is none. plant: its agonist. believed: its
/// antagonist.
std::optional<JointConditions> read_joint(const toml::table& document, const PlantSettings& plant,
                                          const control::PhysicalParameters& believed,
                                          config::Diagnostics& diagnostics);
double read_co_contraction_W(const toml::table& document, double max_W,
                             config::Diagnostics& diagnostics);

/// What the board believes; antagonist: of a joint.
struct BelievedMuscles {
  control::PhysicalParameters muscle;
  control::PhysicalParameters antagonist;
};

/// [muscle] and [joint.antagonist_muscle]; each key that is absent is as in [plant] and [joint].
BelievedMuscles read_muscles(const toml::table& document, config::Diagnostics& diagnostics);

/// Every other table than [simulation] and [[event]], and the keys that no table has.
Conditions read_conditions(const toml::table& document, const BelievedMuscles& believed,
                           double step_s, config::Diagnostics& diagnostics);

}  // namespace supercoil::host_sim
