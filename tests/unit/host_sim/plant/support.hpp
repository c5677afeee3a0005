// Effects from reference data, and the deviation of a simulated muscle from scipy's results.
#pragma once

#include <algorithm>
#include <cmath>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "plant/presets.hpp"

namespace supercoil::test {

inline host_sim::PlantEffects real_muscle() {
  return host_sim::preset_muscle(host_sim::MusclePreset::real).effects;
}

/// With the names that tests/reference/muscle_effects.py uses.
inline host_sim::PlantEffects effects_from(const nlohmann::json& json) {
  host_sim::PlantEffects effects;
  std::size_t found = 0;
  for (const host_sim::EffectRange& range : host_sim::effect_ranges) {
    if (!json.contains(range.name)) continue;
    effects.*range.member = json.at(range.name);
    ++found;
  }
  CHECK_EQUAL(json.size(), found);
  return effects;
}

/// The largest distance between two histories, relative to the largest true value.
struct Deviation {
  double largest = 0.0;
  double scale = 0.0;
  void add(double simulated, double truth) {
    largest = std::max(largest, std::abs(simulated - truth));
    scale = std::max(scale, std::abs(truth));
  }
  double relative() const { return largest / scale; }
};

struct Deviations {
  Deviation temperature;
  Deviation position;
  Deviation velocity;
};

/// Deviations at the end of each hold of a case. plant: the case's muscle, at rest.
template <class Plant>
Deviations deviations(Plant& plant, double tick_s, const nlohmann::json& c) {
  const auto ticks = std::lround(c.at("hold_s").get<double>() / tick_s);
  Deviations found;
  for (std::size_t hold = 0; hold < c.at("power_W").size(); ++hold) {
    for (long tick = 0; tick < ticks; ++tick)
      plant.step(c.at("power_W")[hold], c.at("load_N")[hold]);
    found.temperature.add(plant.temperature_rise_K(), c.at("temperature_rise_K")[hold]);
    found.position.add(plant.position_m(), c.at("position_m")[hold]);
    found.velocity.add(plant.velocity_m_per_s(), c.at("velocity_m_per_s")[hold]);
  }
  return found;
}

}  // namespace supercoil::test
