// Effects in real muscles that the paper's equations leave out.
#pragma once

#include <array>
#include <optional>

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::host_sim {

/// Each effect is off by default. Equations and sources: docs/muscles.md. Temperatures are rises
/// above the air at the start. A ratio without a unit is relative to the quantity that it names.
struct PlantEffects {
  // Heat transfer that rises with temperature: shares of free convection and of radiation at
  // heat_transfer_at_K, where the muscle's heat_transfer_W_per_K holds.
  double convection_ratio = 0.0;
  double radiation_ratio = 0.0;
  double heat_transfer_at_K = 60.0;
  double draught_ratio = 1.0;  ///< a factor on the heat transfer
  double air_C = 20.0;         ///< the air at the start; counts for radiation only
  double air_change_K = 0.0;   ///< since the start

  // Force per kelvin at force_ratio_at_K over that of the cold muscle.
  double force_ratio = 1.0;
  double force_ratio_at_K = 130.0;

  // Hysteresis of force over temperature: width of the full loop over hysteresis_range_K.
  double hysteresis_ratio = 0.0;
  double hysteresis_range_K = 40.0;
  double hysteresis_weight = 0.5;  ///< share of the plays in the force

  // Stiffness that is lost between two temperatures; the hanging mass then stretches the muscle.
  double softening_ratio = 0.0;
  double softening_from_K = 20.0;
  double softening_to_K = 60.0;
  double hanging_mass_kg = 0.09;

  // Creep: stiffness of both Maxwell branches together over the cold muscle's.
  double creep_ratio = 0.0;
  double creep_fast_s = 5.0;
  double creep_slow_s = 60.0;

  // The first heating lengthens the muscle for good: by lonely_stroke_m once at lonely_stroke_at_K.
  double lonely_stroke_m = 0.0;
  double lonely_stroke_at_K = 60.0;

  // LuGre friction at the guide: Coulomb friction over the hanging weight.
  double friction_ratio = 0.0;
  double friction_static_ratio = 1.2;  ///< static friction over Coulomb friction
  double friction_bristle_m = 20e-6;   ///< deflection at Coulomb friction
  double friction_stribeck_m_per_s = 1e-3;
  double friction_damping_ratio = 0.2;  ///< bristles' damping over √(their stiffness · mass)

  // Force lost over heating cycles; worn_cycles passed before the start.
  double ageing_ratio = 0.0;
  double ageing_cycles = 10000.0;
  double ageing_cycle_K = 70.0;
  double worn_cycles = 0.0;

  // Water in the thread, as a ratio of its mass, adds force, and leaves the hot muscle.
  double water_ratio = 0.0;         ///< in the cold muscle
  double water_force_ratio = 10.0;  ///< added force per water ratio
  double drying_K = 80.0;           ///< rise at which no water stays
  double drying_s = 300.0;

  double end_stop_m = -10.0;  ///< the load cannot sink below it
  double ceiling_m = 10.0;    ///< the load cannot rise above it

  int substeps = 4;  ///< of the mechanics, in each thermal step

  friend bool operator==(const PlantEffects&, const PlantEffects&) = default;

  /// Whether anything differs from the paper's muscle.
  bool any() const;
};

/// A numeric member of PlantEffects: its key and its allowed range (ends included).
struct EffectRange {
  const char* name;
  double PlantEffects::*member;
  double min;
  double max;
};
inline constexpr std::array<EffectRange, 33> effect_ranges{{
    {"convection_ratio", &PlantEffects::convection_ratio, 0.0, 1.0},
    {"radiation_ratio", &PlantEffects::radiation_ratio, 0.0, 1.0},
    {"heat_transfer_at_K", &PlantEffects::heat_transfer_at_K, 1.0, 300.0},
    {"draught_ratio", &PlantEffects::draught_ratio, 0.01, 100.0},
    {"force_ratio", &PlantEffects::force_ratio, 0.1, 20.0},
    {"force_ratio_at_K", &PlantEffects::force_ratio_at_K, 1.0, 300.0},
    {"hysteresis_ratio", &PlantEffects::hysteresis_ratio, 0.0, 0.5},
    {"hysteresis_range_K", &PlantEffects::hysteresis_range_K, 1.0, 300.0},
    {"hysteresis_weight", &PlantEffects::hysteresis_weight, 0.05, 0.95},
    {"softening_ratio", &PlantEffects::softening_ratio, 0.0, 0.9},
    {"softening_from_K", &PlantEffects::softening_from_K, -50.0, 300.0},
    {"softening_to_K", &PlantEffects::softening_to_K, -50.0, 400.0},
    {"hanging_mass_kg", &PlantEffects::hanging_mass_kg, 0.0, 1e3},
    {"creep_ratio", &PlantEffects::creep_ratio, 0.0, 1.0},
    {"creep_fast_s", &PlantEffects::creep_fast_s, 0.1, 1e5},
    {"creep_slow_s", &PlantEffects::creep_slow_s, 0.1, 1e5},
    {"lonely_stroke_m", &PlantEffects::lonely_stroke_m, 0.0, 1.0},
    {"lonely_stroke_at_K", &PlantEffects::lonely_stroke_at_K, 1.0, 300.0},
    {"friction_ratio", &PlantEffects::friction_ratio, 0.0, 1.0},
    {"friction_static_ratio", &PlantEffects::friction_static_ratio, 1.0, 10.0},
    {"friction_bristle_m", &PlantEffects::friction_bristle_m, 1e-6, 1e-2},
    {"friction_stribeck_m_per_s", &PlantEffects::friction_stribeck_m_per_s, 1e-5, 1.0},
    {"friction_damping_ratio", &PlantEffects::friction_damping_ratio, 0.0, 10.0},
    {"ageing_ratio", &PlantEffects::ageing_ratio, 0.0, 1.0},
    {"ageing_cycles", &PlantEffects::ageing_cycles, 1.0, 1e9},
    {"ageing_cycle_K", &PlantEffects::ageing_cycle_K, 1.0, 300.0},
    {"worn_cycles", &PlantEffects::worn_cycles, 0.0, 1e9},
    {"water_ratio", &PlantEffects::water_ratio, 0.0, 0.2},
    {"water_force_ratio", &PlantEffects::water_force_ratio, -20.0, 20.0},
    {"drying_K", &PlantEffects::drying_K, 1.0, 300.0},
    {"drying_s", &PlantEffects::drying_s, 0.1, 1e6},
    {"end_stop_m", &PlantEffects::end_stop_m, -10.0, 0.0},
    {"ceiling_m", &PlantEffects::ceiling_m, 0.0, 10.0},
}};

/// The first number that is out of its range or contradicts another one.
std::optional<control::Violation> check(const PlantEffects& effects);

}  // namespace supercoil::host_sim
