// Every number of a stored set, with its place in the file: what writes and what reads it agree.
#pragma once

#include <array>
#include <string_view>

#include "storage/learned.hpp"

namespace supercoil::storage {

struct Field {
  std::string_view table;
  std::string_view key;
  double& (*of)(Learned&);
};

/// In the order of the file; the fields of a table stand together.
inline constexpr std::array<Field, 20> fields{{
    {"muscle", "thermal_mass_J_per_K",
     [](Learned& l) -> double& { return l.muscle.thermal_mass_J_per_K; }},
    {"muscle", "heat_transfer_W_per_K",
     [](Learned& l) -> double& { return l.muscle.heat_transfer_W_per_K; }},
    {"muscle", "stiffness_N_per_m",
     [](Learned& l) -> double& { return l.muscle.stiffness_N_per_m; }},
    {"muscle", "damping_Ns_per_m", [](Learned& l) -> double& { return l.muscle.damping_Ns_per_m; }},
    {"muscle", "moving_mass_kg", [](Learned& l) -> double& { return l.muscle.moving_mass_kg; }},
    {"muscle", "force_per_kelvin_N_per_K",
     [](Learned& l) -> double& { return l.muscle.force_per_kelvin_N_per_K; }},
    {"calibration", "position_offset_m",
     [](Learned& l) -> double& { return l.calibration.position_offset_m; }},
    {"calibration", "position_scale",
     [](Learned& l) -> double& { return l.calibration.position_scale; }},
    {"calibration", "cold_resistance_Ohm",
     [](Learned& l) -> double& { return l.calibration.cold_resistance_Ohm; }},
    {"senses", "supply_gain", [](Learned& l) -> double& { return l.senses.supply_gain; }},
    {"senses", "current_gain", [](Learned& l) -> double& { return l.senses.current_gain; }},
    {"senses", "error_ratio", [](Learned& l) -> double& { return l.senses.error_ratio; }},
    {"senses", "compared_s", [](Learned& l) -> double& { return l.senses.compared_s; }},
    {"heat", "time_constant_s", [](Learned& l) -> double& { return l.heat.time_constant_s; }},
    {"heat", "time_constant_at_W", [](Learned& l) -> double& { return l.heat.time_constant_at_W; }},
    {"heat", "steady_rise_K", [](Learned& l) -> double& { return l.heat.steady_rise_K; }},
    {"heat", "steady_error_K", [](Learned& l) -> double& { return l.heat.steady_error_K; }},
    {"heat", "steady_min_W", [](Learned& l) -> double& { return l.heat.steady_min_W; }},
    {"heat", "steady_max_W", [](Learned& l) -> double& { return l.heat.steady_max_W; }},
    {"small_motions", "answer_ratio", [](Learned& l) -> double& { return l.answer_ratio; }},
}};

/// Tables that a file may lack, where nothing is known of what they hold: files of earlier versions
/// have none of them.
inline constexpr bool may_lack(std::string_view table) {
  return table == "senses" || table == "heat" || table == "small_motions";
}
/// A set without a muscle has no other table.
inline bool is_stored(const Field& field, const Learned& learned) {
  if (field.table == "senses") return learned.senses != SenseComparison{};
  if (field.table == "heat") return learned.heat != HeatFacts{};
  if (field.table == "small_motions") return learned.knows_muscle && learned.answer_ratio != 0.0;
  return learned.knows_muscle;
}

}  // namespace supercoil::storage
