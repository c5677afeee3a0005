// The tables of a scenario, one by one.
#pragma once

#include <optional>
#include <vector>

#include <toml++/toml.h>

#include "config/diagnostics.hpp"
#include "config/section.hpp"
#include "scenario/conditions.hpp"
#include "scenario/reference.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// Finishes the section.
PlantSettings read_plant(config::Section section);

/// A table of the document, "joint.antagonist", laid over another one of it: what it lacks is as
/// that one says.
config::Section laid_over(const toml::table& document, const std::string& path, const char* under,
                          config::Diagnostics& diagnostics);
/// What was found in a table that was laid over another one, but for what was said of that already.
void add_new(const config::Diagnostics& found, config::Diagnostics& diagnostics);

/// Its physical parameters alone. Does not finish the section.
control::PhysicalParameters read_plant_parameters(config::Section& section);

/// What the muscle moves, by which defaults differ: of the paper's and of others a load, a joint
/// that another muscle draws back, one that a spring or a weight does.
enum class Moves { paper_load, load, joint, spring_joint };

Reference read_reference(config::Section& section, Moves moves);

/// [joint] but for its co-contraction; empty: there is none. plant: its agonist. believed: its
/// antagonist.
std::optional<JointConditions> read_joint(const toml::table& document, const PlantSettings& plant,
                                          const control::PhysicalParameters& believed,
                                          config::Diagnostics& diagnostics);
/// Of a joint of two muscles.
double read_co_contraction_W(const toml::table& document, double max_W,
                             config::Diagnostics& diagnostics);

/// [bundle]: the muscles beside [plant]'s, each as [plant] says where its own table does not.
/// Empty: there is none.
std::vector<PlantSettings> read_companions(const toml::table& document,
                                           config::Diagnostics& diagnostics);
/// As one muscle with the power of each for input: what moves is the bundle's, heat the first's.
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

/// Every other table than [simulation] and [[event]], and the keys that no table has.
Conditions read_conditions(const toml::table& document, const BelievedMuscles& believed,
                           double step_s, config::Diagnostics& diagnostics);

}  // namespace supercoil::host_sim
