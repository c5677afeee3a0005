// Every number of a stored set and its place in the file, shared by the writer and the reader.
#pragma once

#include <array>
#include <string_view>

#include "board/learned.hpp"

namespace supercoil::storage {

/// A number of a stored set, its table and its key.
struct Field {
  std::string_view table;
  std::string_view key;
  double& (*of)(board::Learned&);
};

/// In the order of the file; the fields of a table are adjacent.
inline constexpr std::array<Field, 26> fields{{
    {"muscle", "thermal_mass_J_per_K",
     [](board::Learned& l) -> double& { return l.muscle.thermal_mass_J_per_K; }},
    {"muscle", "heat_transfer_W_per_K",
     [](board::Learned& l) -> double& { return l.muscle.heat_transfer_W_per_K; }},
    {"muscle", "stiffness_N_per_m",
     [](board::Learned& l) -> double& { return l.muscle.stiffness_N_per_m; }},
    {"muscle", "damping_Ns_per_m",
     [](board::Learned& l) -> double& { return l.muscle.damping_Ns_per_m; }},
    {"muscle", "moving_mass_kg",
     [](board::Learned& l) -> double& { return l.muscle.moving_mass_kg; }},
    {"muscle", "force_per_kelvin_N_per_K",
     [](board::Learned& l) -> double& { return l.muscle.force_per_kelvin_N_per_K; }},
    {"calibration", "position_offset_m",
     [](board::Learned& l) -> double& { return l.calibration.position_offset_m; }},
    {"calibration", "position_scale",
     [](board::Learned& l) -> double& { return l.calibration.position_scale; }},
    {"calibration", "cold_resistance_Ohm",
     [](board::Learned& l) -> double& { return l.calibration.cold_resistance_Ohm; }},
    {"senses", "supply_gain", [](board::Learned& l) -> double& { return l.senses.supply_gain; }},
    {"senses", "current_gain", [](board::Learned& l) -> double& { return l.senses.current_gain; }},
    {"senses", "error_ratio", [](board::Learned& l) -> double& { return l.senses.error_ratio; }},
    {"senses", "compared_s", [](board::Learned& l) -> double& { return l.senses.compared_s; }},
    {"heat", "time_constant_s",
     [](board::Learned& l) -> double& { return l.heat.time_constant_s; }},
    {"heat", "time_constant_at_W",
     [](board::Learned& l) -> double& { return l.heat.time_constant_at_W; }},
    {"heat", "steady_rise_K", [](board::Learned& l) -> double& { return l.heat.steady_rise_K; }},
    {"heat", "steady_error_K", [](board::Learned& l) -> double& { return l.heat.steady_error_K; }},
    {"heat", "steady_min_W", [](board::Learned& l) -> double& { return l.heat.steady_min_W; }},
    {"heat", "steady_max_W", [](board::Learned& l) -> double& { return l.heat.steady_max_W; }},
    {"small_motions", "response_ratio",
     [](board::Learned& l) -> double& { return l.response_ratio; }},
    {"linear_model", "unexplained_ratio",
     [](board::Learned& l) -> double& { return l.unexplained_ratio; }},
    {"identification", "theta1_deviation_ratio",
     [](board::Learned& l) -> double& { return l.identification.deviation_ratio[0]; }},
    {"identification", "theta2_deviation_ratio",
     [](board::Learned& l) -> double& { return l.identification.deviation_ratio[1]; }},
    {"identification", "theta3_deviation_ratio",
     [](board::Learned& l) -> double& { return l.identification.deviation_ratio[2]; }},
    {"identification", "theta4_deviation_ratio",
     [](board::Learned& l) -> double& { return l.identification.deviation_ratio[3]; }},
    {"identification", "identified_s",
     [](board::Learned& l) -> double& { return l.identification.identified_s; }},
}};

/// The field's key in a file of this format.
constexpr std::string_view key_in(const Field& field, unsigned format) {
  return format == 1 && field.key == "response_ratio" ? "answer_ratio" : field.key;
}

/// Tables that a file lacks when their content is not known. Files of earlier versions have none of
/// them.
inline constexpr bool is_optional_table(std::string_view table) {
  return table == "senses" || table == "heat" || table == "small_motions" ||
         table == "linear_model" || table == "identification";
}
/// Without a muscle, only senses and heat are stored.
inline bool is_stored(const Field& field, const board::Learned& learned) {
  if (field.table == "senses") return learned.senses != board::SenseComparison{};
  if (field.table == "heat") return learned.heat != board::ThermalFacts{};
  if (field.table == "small_motions") return learned.has_muscle && learned.response_ratio != 0.0;
  if (field.table == "linear_model") return learned.has_muscle && learned.unexplained_ratio != 0.0;
  if (field.table == "identification")
    return learned.has_muscle && learned.identification != board::Identification{};
  return learned.has_muscle;
}

}  // namespace supercoil::storage
