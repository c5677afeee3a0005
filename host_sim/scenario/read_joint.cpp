// [joint]: two muscles that turn one lever against each other, or one against a spring or a weight.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "config/read_control.hpp"
#include "config/read_lever.hpp"
#include "loop/hanging_arm.hpp"
#include "scenario/read_tables.hpp"

namespace supercoil::host_sim {

namespace {

using config::Diagnostics;
using config::Section;

constexpr double rad_per_deg = std::numbers::pi / 180.0;
/// If nothing else opposes: as stiff as the paper's muscle at the default lever.
constexpr double default_spring_Nm_per_rad = 0.0036;
constexpr double min_spring_Nm_per_rad = 1e-6;

/// If a weight opposes: about as stiff, with the arm hanging half back, as the default spring.
constexpr double default_weight_Nm = 0.005;
constexpr double default_hangs_at_deg = -45.0;

enum class OpposedBy { muscle, spring, gravity };
constexpr control::Names<OpposedBy, 3> opposed_by_names{{{"muscle", OpposedBy::muscle},
                                                         {"spring", OpposedBy::spring},
                                                         {"gravity", OpposedBy::gravity}}};

/// Keys of [plant] that have another name in a joint.
struct RenamedInJoint {
  const char* plant;
  const char* joint;
};
constexpr std::array<RenamedInJoint, 4> renamed_in_joint{{{"load_N", "load_Nm"},
                                                          {"friction_ratio", "friction_ratio"},
                                                          {"end_stop_m", "min_angle_deg"},
                                                          {"ceiling_m", "max_angle_deg"}}};

/// An arm at rest stretches the cold muscle at the angle 0.
void read_weight(Section& section, OpposedBy opposed_by, JointPlantSettings& p) {
  constexpr const char* angle_key = "hangs_at_deg";
  constexpr const char* pretension_key = "pretension_N";
  if (opposed_by != OpposedBy::gravity) {
    p.pretension_N = section.number(pretension_key, p.pretension_N, {0.0, 1e3});
    p.weight_Nm = section.number("weight_Nm", 0.0, {-100.0, 100.0});
    if (section.has(angle_key)) section.wrong(angle_key, "needs [joint] opposed_by = \"gravity\"");
    section.allow({angle_key});
    return;
  }
  p.weight_Nm = section.number("weight_Nm", default_weight_Nm, config::weight_range_Nm);
  p.hangs_at_rad =
      rad_per_deg * section.number(angle_key, default_hangs_at_deg, config::hangs_at_range_deg);
  p.spring_pretensions = false;
  p.pretension_N = p.weight_Nm * std::sin(-p.hangs_at_rad) / p.lever.zero_radius_m();
  if (section.has(pretension_key))
    section.wrong(pretension_key, "follows from weight_Nm, hangs_at_deg and lever_m; remove it");
  section.allow({pretension_key});
}

JointPlantSettings read_lever(Section& section) {
  JointPlantSettings p;
  const OpposedBy opposed_by = section.choice("opposed_by", OpposedBy::muscle, opposed_by_names);
  const bool pair = opposed_by == OpposedBy::muscle;
  const bool by_spring = opposed_by == OpposedBy::spring;
  if (pair) p.antagonist.emplace();
  p.lever = config::read_lever(section, {1e-3, 1.0}, p.lever.zero_radius_m());
  if (pair) {
    const double lever_m = p.lever.zero_radius_m();
    p.antagonist_lever_ratio = section.number("antagonist_lever_m", lever_m, {1e-3, 1.0}) / lever_m;
  }
  p.inertia_kg_m2 = section.number("inertia_kg_m2", p.inertia_kg_m2, {1e-9, 100.0});
  p.damping_Nms_per_rad = section.number("damping_Nms_per_rad", 0.0, {0.0, 100.0});
  p.spring_Nm_per_rad =
      section.number("spring_Nm_per_rad", by_spring ? default_spring_Nm_per_rad : 0.0,
                     {by_spring ? min_spring_Nm_per_rad : 0.0, 1e3});
  p.friction_ratio = section.number("friction_ratio", 0.0, {0.0, 1.0});
  read_weight(section, opposed_by, p);
  p.min_angle_rad = rad_per_deg * section.number("min_angle_deg", -45.0, {-180.0, -1.0});
  p.max_angle_rad = rad_per_deg * section.number("max_angle_deg", 45.0, {1.0, 180.0});
  return p;
}

void refuse_keys_of_one_muscle(Section section) {
  for (const RenamedInJoint& key : renamed_in_joint) {
    if (!section.has(key.plant)) continue;
    section.wrong(key.plant,
                  std::string("is for a single muscle; with a [joint] set joint.") + key.joint);
  }
}

/// The joint as a linear muscle: inertia and parallel springs along the arc at the muscle's lever.
/// other: null if there is none. other_ratio: its lever over this one.
control::PhysicalParameters along_the_arc(const JointPlantSettings& joint, double lever_m,
                                          const control::PhysicalParameters& muscle,
                                          const control::PhysicalParameters* other = nullptr,
                                          double other_ratio = 1.0) {
  const double lever2 = lever_m * lever_m;
  control::PhysicalParameters p = muscle;
  p.stiffness_N_per_m += joint.spring_Nm_per_rad / lever2;
  p.damping_Ns_per_m += joint.damping_Nms_per_rad / lever2;
  if (other != nullptr) {
    p.stiffness_N_per_m += other_ratio * other_ratio * other->stiffness_N_per_m;
    p.damping_Ns_per_m += other_ratio * other_ratio * other->damping_Ns_per_m;
  }
  const PlaceInJoint arm = single_muscle_place(joint);
  if (arm.weighs()) p.stiffness_N_per_m += HangingArm::stiffness_at_zero_N_per_m(arm);
  p.moving_mass_kg = joint.inertia_kg_m2 / lever2;
  return p;
}

void refuse_keys_of_two_muscles(Section& section) {
  for (const char* key : {"antagonist", "antagonist_muscle", "co_contraction_W"}) {
    if (section.has(key)) section.wrong(key, "needs [joint] opposed_by = \"muscle\"");
    section.allow({key});
  }
}

void refuse_impossible(const control::PhysicalParameters& believed, const std::string& table,
                       const toml::table& document, Diagnostics& diagnostics) {
  const auto violation = control::check(believed);
  if (!violation) return;
  std::ostringstream message;
  message << "makes " << table << "." << violation->quantity << " = " << violation->value
          << ", which must be " << violation->min << " to " << violation->max;
  diagnostics.add(static_cast<int>(document["joint"].node()->source().begin.line), "joint",
                  message.str());
}

}  // namespace

std::optional<JointConditions> read_joint(const toml::table& document, const PlantSettings& plant,
                                          const control::PhysicalParameters& believed,
                                          Diagnostics& diagnostics) {
  if (!document.contains("joint")) return std::nullopt;
  Section root(&document, "", diagnostics);
  Section section = root.section("joint");
  JointConditions joint;
  joint.plant = read_lever(section);
  joint.load_Nm = section.number("load_Nm", 0.0, {-100.0, 100.0});
  refuse_keys_of_one_muscle(Section(document["plant"].as_table(), "plant", diagnostics));
  if (joint.plant.antagonist) {
    joint.antagonist = {plant, believed};
    section.section("antagonist_muscle");  // read elsewhere
    const Section own = section.section("antagonist");
    if (own.table() != nullptr) {
      refuse_keys_of_one_muscle(own);
      Diagnostics found(diagnostics.file(), diagnostics.keys());
      joint.antagonist->plant = read_plant(overlaid(document, "joint.antagonist", "plant", found));
      add_new(found, diagnostics);
    }
    section.allow({"co_contraction_W"});  // read once the power limits are known
  } else {
    refuse_keys_of_two_muscles(section);
  }
  section.finish();
  return joint;
}

double read_co_contraction_W(const toml::table& document, double max_W, Diagnostics& diagnostics) {
  Section section(document["joint"].as_table(), "joint", diagnostics);
  return section.number("co_contraction_W",
                        std::min(AntagonistConditions{}.co_contraction_W, max_W), {0.0, max_W});
}

BelievedMuscles read_muscles(const toml::table& document, Diagnostics& diagnostics) {
  Diagnostics elsewhere(diagnostics.file());  // reported when it is read again, elsewhere
  Section plant(document["plant"].as_table(), "plant", elsewhere);
  const auto agonist = read_plant_parameters(plant);
  Section muscle(document["muscle"].as_table(), "muscle", diagnostics);
  if (document["joint"].as_table() == nullptr) {
    const auto believed = config::read_parameters(muscle, bundle_parameters(document, agonist));
    muscle.finish();
    return {believed, believed};
  }
  Section section(document["joint"].as_table(), "joint", elsewhere);
  const JointPlantSettings lever = read_lever(section);
  const double lever_m = lever.lever.zero_radius_m();
  if (!lever.antagonist) {
    const auto believed = config::read_parameters(muscle, along_the_arc(lever, lever_m, agonist));
    muscle.finish();
    if (elsewhere.empty()) refuse_impossible(believed, "muscle", document, diagnostics);
    return {believed, believed};
  }
  Section other = overlaid(document, "joint.antagonist", "plant", elsewhere);
  const auto antagonist = read_plant_parameters(other);

  const double ratio = lever.antagonist_lever_ratio;
  BelievedMuscles believed;
  believed.muscle =
      config::read_parameters(muscle, along_the_arc(lever, lever_m, agonist, &antagonist, ratio));
  muscle.finish();
  Diagnostics found(diagnostics.file(), diagnostics.keys());
  Section other_muscle = overlaid(document, "joint.antagonist_muscle", "muscle", found);
  believed.antagonist = config::read_parameters(
      other_muscle, along_the_arc(lever, ratio * lever_m, antagonist, &agonist, 1.0 / ratio));
  other_muscle.finish();
  add_new(found, diagnostics);
  if (elsewhere.empty()) {
    refuse_impossible(believed.muscle, "muscle", document, diagnostics);
    refuse_impossible(believed.antagonist, "joint.antagonist_muscle", document, diagnostics);
  }
  return believed;
}

}  // namespace supercoil::host_sim
