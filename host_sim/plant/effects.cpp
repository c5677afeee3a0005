#include "plant/effects.hpp"

namespace supercoil::host_sim {

bool PlantEffects::any() const {
  return convection_ratio != 0.0 || radiation_ratio != 0.0 || draught_ratio != 1.0 ||
         air_change_K != 0.0 || force_ratio != 1.0 || hysteresis_ratio != 0.0 ||
         softening_ratio != 0.0 || creep_ratio != 0.0 || lonely_stroke_m != 0.0 ||
         friction_ratio != 0.0 || ageing_ratio != 0.0 || water_ratio != 0.0 || end_stop_m > -10.0 ||
         ceiling_m < 10.0;
}

std::optional<control::Violation> check(const PlantEffects& effects) {
  for (const EffectRange& range : effect_ranges) {
    const double value = effects.*range.member;
    if (!(value >= range.min && value <= range.max))
      return control::Violation{range.name, value, range.min, range.max};
  }
  const double left = 1.0 - effects.convection_ratio;
  if (effects.radiation_ratio > left)
    return control::Violation{"radiation_ratio", effects.radiation_ratio, 0.0, left};
  const double min_K = effects.softening_from_K + 1.0;
  if (effects.softening_to_K < min_K)
    return control::Violation{"softening_to_K", effects.softening_to_K, min_K, 400.0};
  return {};
}

}  // namespace supercoil::host_sim
