#include "telemetry/frames.hpp"

#include <algorithm>

#include <supercoil.h>

#include "modes/result.hpp"
#include "telemetry/opcodes.hpp"
#include "telemetry/pack.hpp"

namespace supercoil::telemetry {

namespace {

constexpr double hertz(unsigned period_ms) {
  return 1000.0 / period_ms;
}

bool has(const Row& row, RowFlag flag) {
  return (row.flags & flag) != 0;
}

}  // namespace

const std::array<MessageInfo, messages>& all_messages() {
  static constexpr std::array<MessageInfo, messages> all{{
      {"measurement", SUPERCOIL_MEASUREMENT_LENGTH, hertz(SUPERCOIL_MEASUREMENT_CYCLE_TIME_MS)},
      {"tracking", SUPERCOIL_TRACKING_LENGTH, hertz(SUPERCOIL_TRACKING_CYCLE_TIME_MS)},
      {"power", SUPERCOIL_POWER_LENGTH, hertz(SUPERCOIL_POWER_CYCLE_TIME_MS)},
      {"heater", SUPERCOIL_HEATER_LENGTH, hertz(SUPERCOIL_HEATER_CYCLE_TIME_MS)},
      {"temperature", SUPERCOIL_TEMPERATURE_LENGTH, hertz(SUPERCOIL_TEMPERATURE_CYCLE_TIME_MS)},
      {"estimate", SUPERCOIL_ESTIMATE_LENGTH, hertz(SUPERCOIL_ESTIMATE_CYCLE_TIME_MS)},
      {"margin", SUPERCOIL_MARGIN_LENGTH, hertz(SUPERCOIL_MARGIN_CYCLE_TIME_MS)},
      {"limit", SUPERCOIL_LIMIT_LENGTH, hertz(SUPERCOIL_LIMIT_CYCLE_TIME_MS)},
      {"timing", SUPERCOIL_TIMING_LENGTH, hertz(SUPERCOIL_TIMING_CYCLE_TIME_MS), true},
      {"status", SUPERCOIL_STATUS_LENGTH, hertz(SUPERCOIL_STATUS_CYCLE_TIME_MS)},
      {"gain", SUPERCOIL_GAIN_LENGTH, hertz(SUPERCOIL_GAIN_CYCLE_TIME_MS)},
  }};
  return all;
}

hal::CanFrame emergency(Node node, const Row& row) {
  constexpr double highest_s = 281474976.710655;  // 48 bits of microseconds
  supercoil_emergency_t m{};
  m.fault = row.fault;
  m.state = row.state;
  const double time_s = 1e-9 * static_cast<double>(row.time_ns);
  m.board_time_s = supercoil_emergency_board_time_s_encode(std::clamp(time_s, 0.0, highest_s));
  return packed(SUPERCOIL_EMERGENCY_FRAME_ID, SUPERCOIL_EMERGENCY_LENGTH, node, m,
                supercoil_emergency_pack);
}

hal::CanFrame first_cause(Node node, const Row& row) {
  supercoil_first_cause_t m{};
  m.measured = row.margin_measured;
  m.limit = row.margin_limit;
  return packed(SUPERCOIL_FIRST_CAUSE_FRAME_ID, SUPERCOIL_FIRST_CAUSE_LENGTH, node, m,
                supercoil_first_cause_pack);
}

hal::CanFrame refused_value(Node node, double value, double nearest) {
  supercoil_refused_value_t m{};
  m.value = static_cast<float>(value);
  m.nearest = static_cast<float>(nearest);
  return packed(SUPERCOIL_REFUSED_VALUE_FRAME_ID, SUPERCOIL_REFUSED_VALUE_LENGTH, node, m,
                supercoil_refused_value_pack);
}

hal::CanFrame measurement(Node node, const Row& row) {
  supercoil_measurement_t m{};
  m.position_m =
      scaled(row.position_m, SUPERCOIL_MEASUREMENT_POSITION_M_NOT_AVAILABLE_CHOICE,
             supercoil_measurement_position_m_encode, supercoil_measurement_position_m_decode);
  m.resistance_ohm = scaled(
      row.resistance_Ohm, SUPERCOIL_MEASUREMENT_RESISTANCE_OHM_NOT_AVAILABLE_CHOICE,
      supercoil_measurement_resistance_ohm_encode, supercoil_measurement_resistance_ohm_decode);
  m.resistance_age_s = scaled(
      row.resistance_age_s, SUPERCOIL_MEASUREMENT_RESISTANCE_AGE_S_NOT_AVAILABLE_CHOICE,
      supercoil_measurement_resistance_age_s_encode, supercoil_measurement_resistance_age_s_decode);
  return packed(SUPERCOIL_MEASUREMENT_FRAME_ID, SUPERCOIL_MEASUREMENT_LENGTH, node, m,
                supercoil_measurement_pack);
}

hal::CanFrame tracking(Node node, const Row& row) {
  const bool tracks = row.mode == static_cast<std::uint8_t>(Mode::position);
  const double reference_m = tracks ? row.reference : NAN;
  const double model_m = tracks ? row.model_m : NAN;
  supercoil_tracking_t m{};
  m.reference_m =
      scaled(reference_m, SUPERCOIL_TRACKING_REFERENCE_M_NOT_AVAILABLE_CHOICE,
             supercoil_tracking_reference_m_encode, supercoil_tracking_reference_m_decode);
  m.model_m = scaled(model_m, SUPERCOIL_TRACKING_MODEL_M_NOT_AVAILABLE_CHOICE,
                     supercoil_tracking_model_m_encode, supercoil_tracking_model_m_decode);
  m.error_m = scaled(row.position_m - model_m, SUPERCOIL_TRACKING_ERROR_M_NOT_AVAILABLE_CHOICE,
                     supercoil_tracking_error_m_encode, supercoil_tracking_error_m_decode);
  return packed(SUPERCOIL_TRACKING_FRAME_ID, SUPERCOIL_TRACKING_LENGTH, node, m,
                supercoil_tracking_pack);
}

hal::CanFrame power(Node node, const Row& row) {
  supercoil_power_t m{};
  m.demanded_w = scaled(row.wanted_W, SUPERCOIL_POWER_DEMANDED_W_NOT_AVAILABLE_CHOICE,
                        supercoil_power_demanded_w_encode, supercoil_power_demanded_w_decode);
  m.applied_w = scaled(row.applied_W, SUPERCOIL_POWER_APPLIED_W_NOT_AVAILABLE_CHOICE,
                       supercoil_power_applied_w_encode, supercoil_power_applied_w_decode);
  m.limited_by = row.limited_by;
  m.limited = has(row, row_limited);
  return packed(SUPERCOIL_POWER_FRAME_ID, SUPERCOIL_POWER_LENGTH, node, m, supercoil_power_pack);
}

hal::CanFrame heater(Node node, const Row& row) {
  supercoil_heater_t m{};
  m.supply_v = scaled(row.supply_V, SUPERCOIL_HEATER_SUPPLY_V_NOT_AVAILABLE_CHOICE,
                      supercoil_heater_supply_v_encode, supercoil_heater_supply_v_decode);
  m.current_a = scaled(row.current_A, SUPERCOIL_HEATER_CURRENT_A_NOT_AVAILABLE_CHOICE,
                       supercoil_heater_current_a_encode, supercoil_heater_current_a_decode);
  m.duty = scaled(row.duty, SUPERCOIL_HEATER_DUTY_NOT_AVAILABLE_CHOICE,
                  supercoil_heater_duty_encode, supercoil_heater_duty_decode);
  return packed(SUPERCOIL_HEATER_FRAME_ID, SUPERCOIL_HEATER_LENGTH, node, m, supercoil_heater_pack);
}

hal::CanFrame temperature(Node node, const Row& row) {
  supercoil_temperature_t m{};
  m.coldest_c =
      scaled(row.coldest_C, SUPERCOIL_TEMPERATURE_COLDEST_C_NOT_AVAILABLE_CHOICE,
             supercoil_temperature_coldest_c_encode, supercoil_temperature_coldest_c_decode);
  m.hottest_c =
      scaled(row.hottest_C, SUPERCOIL_TEMPERATURE_HOTTEST_C_NOT_AVAILABLE_CHOICE,
             supercoil_temperature_hottest_c_encode, supercoil_temperature_hottest_c_decode);
  return packed(SUPERCOIL_TEMPERATURE_FRAME_ID, SUPERCOIL_TEMPERATURE_LENGTH, node, m,
                supercoil_temperature_pack);
}

hal::CanFrame margin(Node node, const Row& row) {
  supercoil_margin_t m{};
  m.fault = row.turn;
  m.used = scaled(row.margin_used, SUPERCOIL_MARGIN_USED_NOT_AVAILABLE_CHOICE,
                  supercoil_margin_used_encode, supercoil_margin_used_decode);
  m.measured = row.margin_measured;
  return packed(SUPERCOIL_MARGIN_FRAME_ID, SUPERCOIL_MARGIN_LENGTH, node, m, supercoil_margin_pack);
}

hal::CanFrame limit(Node node, const Row& row) {
  supercoil_limit_t m{};
  m.fault = row.turn;
  m.limit = row.margin_limit;
  return packed(SUPERCOIL_LIMIT_FRAME_ID, SUPERCOIL_LIMIT_LENGTH, node, m, supercoil_limit_pack);
}

hal::CanFrame gain(Node node, const Row& row) {
  supercoil_gain_t m{};
  m.gain = row.gain_turn;
  m.value = row.gain;
  return packed(SUPERCOIL_GAIN_FRAME_ID, SUPERCOIL_GAIN_LENGTH, node, m, supercoil_gain_pack);
}

hal::CanFrame timing(Node node, const BoardTiming& timing) {
  constexpr std::uint32_t modulo = 1U << 12;
  supercoil_timing_t m{};
  m.late_s = scaled(timing.late_s, SUPERCOIL_TIMING_LATE_S_NOT_AVAILABLE_CHOICE,
                    supercoil_timing_late_s_encode, supercoil_timing_late_s_decode);
  m.execution_s = scaled(timing.execution_s, SUPERCOIL_TIMING_EXECUTION_S_NOT_AVAILABLE_CHOICE,
                         supercoil_timing_execution_s_encode, supercoil_timing_execution_s_decode);
  m.overruns = static_cast<std::uint16_t>(timing.overruns % modulo);
  m.dropped_frames = static_cast<std::uint16_t>(timing.dropped_frames % modulo);
  return packed(SUPERCOIL_TIMING_FRAME_ID, SUPERCOIL_TIMING_LENGTH, node, m, supercoil_timing_pack);
}

hal::CanFrame status(Node node, const Row& row, bool leased, std::uint8_t counter) {
  supercoil_status_t m{};
  m.state = row.state;
  m.mode = row.mode;
  m.fault = row.fault;
  m.limited_by = row.limited_by;
  m.probing = has(row, row_probing);
  m.trusted = has(row, row_trusted);
  m.limited = has(row, row_limited);
  m.leased = leased;
  m.controller = row.controller;
  m.progress = scaled(row.progress, SUPERCOIL_STATUS_PROGRESS_NOT_AVAILABLE_CHOICE,
                      supercoil_status_progress_encode, supercoil_status_progress_decode);
  m.result = row.result;
  m.proof_off = has(row, row_proof_off);
  m.oscillated = has(row, row_oscillated);
  m.friction = (row.identify_notes & note_friction) != 0;
  m.counter = counter;
  m.protocol_version = protocol_version;
  return packed(SUPERCOIL_STATUS_FRAME_ID, SUPERCOIL_STATUS_LENGTH, node, m, supercoil_status_pack);
}

void Asides::take(const Row& row) {
  if (row.aside_turn == 0) {
    *this = {};
  } else if (row.aside_turn <= newest_.size()) {
    newest_.at(row.aside_turn - 1U) = row.aside;
  }
}

std::uint8_t Asides::parameters() const {
  constexpr std::uint8_t first = SUPERCOIL_ESTIMATE_PARAMETER_BIAS_CHOICE;
  const bool some_lack =
      std::ranges::any_of(newest_, [](float value) { return std::isnan(value); });
  return some_lack ? first : static_cast<std::uint8_t>(first + newest_.size());
}

hal::CanFrame estimate(Node node, const Row& row, std::uint8_t parameter,
                       const control::KnownParameters& known, const Asides& asides) {
  const control::Theta theta(row.theta[0], row.theta[1], row.theta[2], row.theta[3]);
  const auto muscle = control::physical_from(theta, known);
  const auto of_muscle = [&](double control::PhysicalParameters::*member) {
    return muscle ? static_cast<float>((*muscle).*member) : NAN;
  };
  supercoil_estimate_t m{};
  m.parameter = parameter;
  m.trusted = has(row, row_trusted);
  // The last one has no bit left here; Status has it.
  m.identify_notes = row.identify_notes & static_cast<std::uint8_t>(~note_friction);
  m.error_bound =
      scaled(row.error_bound, SUPERCOIL_ESTIMATE_ERROR_BOUND_NOT_AVAILABLE_CHOICE,
             supercoil_estimate_error_bound_encode, supercoil_estimate_error_bound_decode);
  m.theta1 = row.theta[0];
  m.theta2 = row.theta[1];
  m.theta3 = row.theta[2];
  m.theta4 = row.theta[3];
  m.thermal_mass_j_per_k = of_muscle(&control::PhysicalParameters::thermal_mass_J_per_K);
  m.heat_transfer_w_per_k = of_muscle(&control::PhysicalParameters::heat_transfer_W_per_K);
  m.stiffness_n_per_m = of_muscle(&control::PhysicalParameters::stiffness_N_per_m);
  m.damping_ns_per_m = of_muscle(&control::PhysicalParameters::damping_Ns_per_m);
  m.bias_w = asides.of(1);
  m.theta1_deviation = asides.of(2);
  m.theta2_deviation = asides.of(3);
  m.theta3_deviation = asides.of(4);
  m.theta4_deviation = asides.of(5);
  m.bias_deviation_w = asides.of(6);
  return packed(SUPERCOIL_ESTIMATE_FRAME_ID, SUPERCOIL_ESTIMATE_LENGTH, node, m,
                supercoil_estimate_pack);
}

}  // namespace supercoil::telemetry
