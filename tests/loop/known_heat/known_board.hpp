// A board that learns about its muscle's heat step by step, and then heats it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "plant/presets.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::test {

/// What is known. Each level includes those before it, but thermometer_alone omits `weighed`.
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
  double reach_ratio = 0;     ///< steady rise over that from the air to 160 °C, with ample power
  Fault fault = Fault::none;  ///< any at all
  bool cooling_found = false;
  bool read = false;
};

/// The seed draws the error of each known quantity from within its error bound.
Findings measure(const MuscleCase& muscle, Knowledge knowledge, std::uint64_t seed);

}  // namespace supercoil::test
