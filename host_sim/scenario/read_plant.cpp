#include <algorithm>
#include <sstream>

#include "config/read_control.hpp"
#include "plant/presets.hpp"
#include "scenario/read_tables.hpp"

namespace supercoil::host_sim {

namespace {

PresetMuscle read_preset(config::Section& section) {
  return preset_muscle(section.choice("preset", MusclePreset::paper, preset_names));
}

PlantEffects read_effects(config::Section& section, PlantEffects effects) {
  for (const EffectRange& range : effect_ranges) {
    effects.*range.member =
        section.number(range.name, effects.*range.member, {range.min, range.max});
  }
  effects.substeps = static_cast<int>(section.integer("substeps", effects.substeps, 1, 100));
  if (const auto violation = check(effects)) {
    std::ostringstream message;
    message << "must be " << violation->min << " to " << violation->max << " with the other values";
    section.wrong(violation->quantity, message.str());
  }
  return effects;
}

}  // namespace

control::PhysicalParameters read_plant_parameters(config::Section& section) {
  return config::read_parameters(section, read_preset(section).parameters);
}

PlantSettings read_plant(config::Section section) {
  PresetMuscle preset = read_preset(section);
  PlantSettings plant;
  plant.parameters = config::read_parameters(section, preset.parameters);
  preset.effects.hanging_mass_kg = plant.parameters.moving_mass_kg;
  plant.effects = read_effects(section, preset.effects);
  plant.air_acts = section.flag("air_acts", preset.air_acts);
  plant.load_N = section.number("load_N", 0.0, {-100.0, 100.0});
  plant.resistance_Ohm = section.number("resistance_Ohm", plant.resistance_Ohm, {0.1, 1e4});
  plant.temperature_coefficient_per_K =
      section.number("temperature_coefficient_per_K", 0.0, {0.0, 0.02});
  section.finish();
  return plant;
}

config::Section overlaid(const toml::table& document, const std::string& path, const char* under,
                         config::Diagnostics& diagnostics) {
  const config::Section own(document.at_path(path).as_table(), path, diagnostics);
  return own.over(document[under].as_table(), under);
}

void add_new(const config::Diagnostics& found, config::Diagnostics& diagnostics) {
  for (const Error& problem : found.problems()) {
    const bool said = std::ranges::any_of(diagnostics.problems(), [&problem](const Error& other) {
      return other.key == problem.key && other.message == problem.message;
    });
    if (said) continue;
    diagnostics.add(problem.line, problem.key, problem.message, problem.value, problem.of_default);
  }
}

}  // namespace supercoil::host_sim
