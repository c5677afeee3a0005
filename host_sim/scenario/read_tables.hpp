// The tables of a scenario, one by one.
#pragma once

#include <optional>
#include <vector>

#include <toml++/toml.h>

#include "config/diagnostics.hpp"
#include "config/section.hpp"
#include "scenario/conditions.hpp"
#include "scenario/read_scenario.hpp"
#include "scenario/reference.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// Finishes the section.
PlantSettings read_plant(config::Section section);

/// A table of the document, such as "joint.antagonist", laid over another of its tables: that one
/// gives the keys that the first lacks.
config::Section overlaid(const toml::table& document, const std::string& path, const char* under,
                         config::Diagnostics& diagnostics);
/// Adds the problems of a table that was laid over another one, except those already reported.
void add_new(const config::Diagnostics& found, config::Diagnostics& diagnostics);

/// Only the physical parameters. Does not finish the section.
control::PhysicalParameters read_plant_parameters(config::Section& section);

/// What the muscle moves, on which defaults depend: a load, of the paper's muscle or of another, a
/// joint that another muscle draws back, or one that a spring or a weight draws back.
enum class Moves { paper_load, load, joint, spring_joint };

Reference read_reference(config::Section& section, Moves moves);

/// [joint] without its co-contraction; empty: no joint. plant: its agonist. believed: its
/// antagonist.
std::optional<JointConditions> read_joint(const toml::table& document, const PlantSettings& plant,
                                          const control::PhysicalParameters& believed,
                                          config::Diagnostics& diagnostics);
/// For a joint of two muscles.
double read_co_contraction_W(const toml::table& document, double max_W,
                             config::Diagnostics& diagnostics);

/// [bundle]: the muscles besides [plant]'s; keys that a muscle's own table lacks are [plant]'s.
/// Empty: no bundle.
std::vector<PlantSettings> read_companions(const toml::table& document,
                                           config::Diagnostics& diagnostics);
/// As one muscle with the power of each as input: motion is the bundle's, heat the first muscle's.
control::PhysicalParameters bundle_parameters(const toml::table& document,
                                              control::PhysicalParameters first);

/// What the board believes; antagonist: of a joint.
struct BelievedMuscles {
  control::PhysicalParameters muscle;
  control::PhysicalParameters antagonist;
};

/// [muscle] and [joint.antagonist_muscle]; each key that is absent is as in [plant], [joint] and
/// [bundle].
BelievedMuscles read_muscles(const toml::table& document, config::Diagnostics& diagnostics);

/// All tables other than [simulation], [muscle] and [[event]]; also finds keys that no table has.
Conditions read_conditions(const toml::table& document, const BelievedMuscles& believed,
                           double step_s, Hardware hardware, config::Diagnostics& diagnostics);

}  // namespace supercoil::host_sim
