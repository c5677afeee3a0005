// A board that finds out about its muscle's heat step by step, and is then made to heat it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "plant/presets.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::test {

/// What is known, each with all before it but that a thermometer may do alone.
enum class Knowledge { defaults, air_and_senses, weighed, thermometer, thermometer_alone };
inline constexpr std::array<std::string_view, 5> knowledge_names{
    "defaults: air 15 to 35 °C, senses never compared", "air ±2 K, senses ±2 %",
    "and the mass ±3 %, identified", "and a thermometer read, ±1 K",
    "air ±2 K, senses ±2 %, thermometer ±1 K"};

struct MuscleCase {
  host_sim::MusclePreset preset;
  double cooling_ratio = 1.0;  ///< true heat transfer over the believed one
  double max_W = 4.5;          ///< while it is identified
};

struct Findings {
  std::int64_t outside_ticks = 0;
  double outside_K = -1e9;    ///< how far at worst; negative: inside
  double median_width_K = 0;  ///< while it follows a motion
  double reach_ratio = 0;  ///< of the rise from the air to 160 °C, where power does not limit it
  Fault fault = Fault::none;  ///< any at all
  bool cooling_found = false;
  bool read = false;
};

/// What everything that is known errs by is drawn from its error, by the seed.
Findings measure(const MuscleCase& muscle, Knowledge knowledge, std::uint64_t seed);

}  // namespace supercoil::test
