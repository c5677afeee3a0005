// Known muscles with their real effects. Sources of the numbers: docs/muscles.md.
#pragma once

#include "supercoil/control/scalar/arithmetic.hpp"

#include "plant/effects.hpp"

namespace supercoil::host_sim {

enum class MusclePreset { paper, real, real_hard, b, c };

inline constexpr control::Names<MusclePreset, 5> preset_names{
    {{"paper", MusclePreset::paper},
     {"real", MusclePreset::real},
     {"real_hard", MusclePreset::real_hard},
     {"b", MusclePreset::b},
     {"c", MusclePreset::c}}};

struct PresetMuscle {
  control::PhysicalParameters parameters;
  PlantEffects effects;
  bool air_acts = true;  ///< the muscle follows a change of the air's temperature
};

PresetMuscle preset_muscle(MusclePreset preset);

}  // namespace supercoil::host_sim
