#include "plant/presets.hpp"

namespace supercoil::host_sim {

namespace {

PlantEffects of_real_muscle() {
  PlantEffects effects;
  effects.convection_ratio = 0.7;
  effects.radiation_ratio = 0.3;
  effects.force_ratio = 6.0;
  effects.hysteresis_ratio = 0.05;
  effects.softening_ratio = 0.4;
  effects.creep_ratio = 0.03;
  effects.lonely_stroke_m = 0.005;
  return effects;
}

PlantEffects of_hard_muscle() {
  PlantEffects effects = of_real_muscle();
  effects.hysteresis_ratio = 0.15;
  effects.creep_ratio = 0.1;
  return effects;
}

PresetMuscle muscle_b() {
  PresetMuscle muscle;
  muscle.parameters = {.thermal_mass_J_per_K = 0.0546,
                       .heat_transfer_W_per_K = 0.0159,
                       .stiffness_N_per_m = 27.0,
                       .damping_Ns_per_m = 3.7,
                       .moving_mass_kg = 0.147,
                       .force_per_kelvin_N_per_K = 0.0030};
  muscle.effects.force_ratio = 7.3 / 3.0;
  muscle.effects.softening_ratio = 5.0 / 27.0;
  muscle.effects.softening_from_K = 0.0;
  muscle.effects.softening_to_K = 130.0;
  muscle.effects.hanging_mass_kg = muscle.parameters.moving_mass_kg;
  return muscle;
}

PresetMuscle muscle_c() {
  PresetMuscle muscle;
  muscle.parameters = {.thermal_mass_J_per_K = 0.522,
                       .heat_transfer_W_per_K = 0.0224,
                       .stiffness_N_per_m = 4.3,
                       .damping_Ns_per_m = 0.72,
                       .moving_mass_kg = 0.029,
                       .force_per_kelvin_N_per_K = 0.0024};
  muscle.effects.force_ratio = 14.3 / 2.4;
  muscle.effects.hanging_mass_kg = muscle.parameters.moving_mass_kg;
  return muscle;
}

}  // namespace

PresetMuscle preset_muscle(MusclePreset preset) {
  switch (preset) {
    case MusclePreset::paper:
      return {.parameters = {}, .effects = {}, .air_acts = false};
    case MusclePreset::real:
      return {.parameters = {}, .effects = of_real_muscle()};
    case MusclePreset::real_hard:
      return {.parameters = {}, .effects = of_hard_muscle()};
    case MusclePreset::b:
      return muscle_b();
    case MusclePreset::c:
      return muscle_c();
  }
  return {};
}

}  // namespace supercoil::host_sim
