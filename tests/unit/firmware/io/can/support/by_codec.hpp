// What the codec that cantools generated reads from a frame of each message.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <type_traits>

#include <supercoil.h>

#include "can/codec.hpp"
#include "unit/firmware/io/can/support/unpacked.hpp"

namespace supercoil::test {

/// In the order of the message's signals; NaN: not available, or not in this frame.
using Values = std::array<double, can::max_signals>;

inline Values values(std::initializer_list<double> read) {
  Values all;
  all.fill(NAN);
  std::copy(read.begin(), read.end(), all.begin());
  return all;
}

/// The codec does not know the raw value that says "not available".
template <class Raw>
double unless(std::type_identity_t<Raw> reserved, Raw raw, double (*decode)(Raw)) {
  return raw == reserved ? NAN : decode(raw);
}

inline Values emergency(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_emergency_unpack);
  return values({supercoil_emergency_fault_decode(m.fault),
                 supercoil_emergency_state_decode(m.state),
                 supercoil_emergency_board_time_s_decode(m.board_time_s)});
}
inline Values first_cause(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_first_cause_unpack);
  return values({supercoil_first_cause_measured_decode(m.measured),
                 supercoil_first_cause_limit_decode(m.limit)});
}
inline Values command(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_command_unpack);
  return values({supercoil_command_crc_decode(m.crc), supercoil_command_counter_decode(m.counter),
                 supercoil_command_opcode_decode(m.opcode),
                 supercoil_command_session_decode(m.session),
                 supercoil_command_value_decode(m.value)});
}
inline Values acknowledge(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_acknowledge_unpack);
  return values({supercoil_acknowledge_crc_decode(m.crc),
                 supercoil_acknowledge_counter_decode(m.counter),
                 supercoil_acknowledge_opcode_decode(m.opcode),
                 supercoil_acknowledge_session_decode(m.session),
                 supercoil_acknowledge_refusal_decode(m.refusal),
                 supercoil_acknowledge_granted_decode(m.granted)});
}
inline Values measurement(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_measurement_unpack);
  return values({unless(-8388608, m.position_m, supercoil_measurement_position_m_decode),
                 unless(16777215, m.resistance_ohm, supercoil_measurement_resistance_ohm_decode),
                 unless(65535, m.resistance_age_s, supercoil_measurement_resistance_age_s_decode)});
}
inline Values tracking(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_tracking_unpack);
  return values({unless(-8388608, m.reference_m, supercoil_tracking_reference_m_decode),
                 unless(-8388608, m.model_m, supercoil_tracking_model_m_decode),
                 unless(-32768, m.error_m, supercoil_tracking_error_m_decode)});
}
inline Values power(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_power_unpack);
  return values({unless(-8388608, m.demanded_w, supercoil_power_demanded_w_decode),
                 unless(-8388608, m.applied_w, supercoil_power_applied_w_decode),
                 supercoil_power_limited_by_decode(m.limited_by),
                 supercoil_power_limited_decode(m.limited)});
}
inline Values heater(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_heater_unpack);
  return values({unless(65535, m.supply_v, supercoil_heater_supply_v_decode),
                 unless(-8388608, m.current_a, supercoil_heater_current_a_decode),
                 unless(65535, m.duty, supercoil_heater_duty_decode)});
}
inline Values temperature(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_temperature_unpack);
  return values({unless(-32768, m.coldest_c, supercoil_temperature_coldest_c_decode),
                 unless(-32768, m.hottest_c, supercoil_temperature_hottest_c_decode)});
}
inline Values estimate(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_estimate_unpack);
  const auto only = [&](int parameter, double value) {
    return m.parameter == parameter ? value : NAN;
  };
  return values({supercoil_estimate_parameter_decode(m.parameter),
                 supercoil_estimate_trusted_decode(m.trusted),
                 supercoil_estimate_identify_notes_decode(m.identify_notes),
                 unless(65535, m.error_bound, supercoil_estimate_error_bound_decode),
                 only(0, supercoil_estimate_theta1_decode(m.theta1)),
                 only(1, supercoil_estimate_theta2_decode(m.theta2)),
                 only(2, supercoil_estimate_theta3_decode(m.theta3)),
                 only(3, supercoil_estimate_theta4_decode(m.theta4)),
                 only(4, supercoil_estimate_thermal_mass_j_per_k_decode(m.thermal_mass_j_per_k)),
                 only(5, supercoil_estimate_heat_transfer_w_per_k_decode(m.heat_transfer_w_per_k)),
                 only(6, supercoil_estimate_stiffness_n_per_m_decode(m.stiffness_n_per_m)),
                 only(7, supercoil_estimate_damping_ns_per_m_decode(m.damping_ns_per_m)),
                 only(8, supercoil_estimate_bias_w_decode(m.bias_w)),
                 only(9, supercoil_estimate_theta1_deviation_decode(m.theta1_deviation)),
                 only(10, supercoil_estimate_theta2_deviation_decode(m.theta2_deviation)),
                 only(11, supercoil_estimate_theta3_deviation_decode(m.theta3_deviation)),
                 only(12, supercoil_estimate_theta4_deviation_decode(m.theta4_deviation)),
                 only(13, supercoil_estimate_bias_deviation_w_decode(m.bias_deviation_w))});
}
inline Values margin(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_margin_unpack);
  return values({supercoil_margin_fault_decode(m.fault),
                 unless(65535, m.used, supercoil_margin_used_decode),
                 supercoil_margin_measured_decode(m.measured)});
}
inline Values limit(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_limit_unpack);
  return values({supercoil_limit_fault_decode(m.fault), supercoil_limit_limit_decode(m.limit)});
}
inline Values timing(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_timing_unpack);
  return values({unless(1048575, m.late_s, supercoil_timing_late_s_decode),
                 unless(1048575, m.execution_s, supercoil_timing_execution_s_decode),
                 supercoil_timing_overruns_decode(m.overruns),
                 supercoil_timing_dropped_frames_decode(m.dropped_frames)});
}
inline Values gain(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_gain_unpack);
  return values({supercoil_gain_gain_decode(m.gain), supercoil_gain_value_decode(m.value)});
}
inline Values refused_value(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_refused_value_unpack);
  return values({supercoil_refused_value_value_decode(m.value),
                 supercoil_refused_value_nearest_decode(m.nearest)});
}
inline Values setting(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_setting_unpack);
  return values({supercoil_setting_crc_decode(m.crc), supercoil_setting_counter_decode(m.counter),
                 supercoil_setting_setting_decode(m.setting),
                 supercoil_setting_refusal_decode(m.refusal),
                 supercoil_setting_session_low_decode(m.session_low),
                 supercoil_setting_value_decode(m.value)});
}
inline Values setting_write(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_setting_write_unpack);
  return values({supercoil_setting_write_crc_decode(m.crc),
                 supercoil_setting_write_counter_decode(m.counter),
                 supercoil_setting_write_setting_decode(m.setting),
                 supercoil_setting_write_session_decode(m.session),
                 supercoil_setting_write_value_decode(m.value)});
}
inline Values setting_read(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_setting_read_unpack);
  return values({supercoil_setting_read_setting_decode(m.setting)});
}
inline Values muscle(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_muscle_unpack);
  return values(
      {supercoil_muscle_quantity_decode(m.quantity), supercoil_muscle_value_decode(m.value)});
}
inline Values muscle_read(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_muscle_read_unpack);
  return values({supercoil_muscle_read_quantity_decode(m.quantity)});
}
inline Values tuning(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_tuning_unpack);
  return values({supercoil_tuning_crc_decode(m.crc), supercoil_tuning_counter_decode(m.counter),
                 supercoil_tuning_place_decode(m.place), supercoil_tuning_tunable_decode(m.tunable),
                 supercoil_tuning_refusal_decode(m.refusal), supercoil_tuning_set_decode(m.set),
                 supercoil_tuning_value_decode(m.value)});
}
inline Values tuning_write(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_tuning_write_unpack);
  return values({supercoil_tuning_write_crc_decode(m.crc),
                 supercoil_tuning_write_counter_decode(m.counter),
                 supercoil_tuning_write_place_decode(m.place),
                 supercoil_tuning_write_tunable_decode(m.tunable),
                 supercoil_tuning_write_session_low_decode(m.session_low),
                 supercoil_tuning_write_value_decode(m.value)});
}
inline Values tuning_read(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_tuning_read_unpack);
  return values({supercoil_tuning_read_place_decode(m.place),
                 supercoil_tuning_read_set_decode(m.set),
                 supercoil_tuning_read_tunable_decode(m.tunable)});
}
inline Values sync(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_sync_unpack);
  return values({supercoil_sync_crc_decode(m.crc), supercoil_sync_sync_decode(m.sync),
                 supercoil_sync_master_time_s_decode(m.master_time_s)});
}
inline Values knot(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_knot_unpack);
  return values(
      {supercoil_knot_crc_decode(m.crc), supercoil_knot_counter_decode(m.counter),
       unless<std::uint16_t>(4095, m.after_s, supercoil_knot_after_s_decode),
       unless<std::int32_t>(-8388608, m.position_m, supercoil_knot_position_m_decode),
       unless<std::int16_t>(-32768, m.velocity_m_per_s, supercoil_knot_velocity_m_per_s_decode)});
}
inline Values play(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_play_unpack);
  return values({supercoil_play_crc_decode(m.crc), supercoil_play_counter_decode(m.counter),
                 supercoil_play_when_decode(m.when), supercoil_play_session_decode(m.session),
                 supercoil_play_sync_decode(m.sync), supercoil_play_after_s_decode(m.after_s)});
}
inline Values trajectory(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_trajectory_unpack);
  return values(
      {supercoil_trajectory_crc_decode(m.crc), supercoil_trajectory_counter_decode(m.counter),
       supercoil_trajectory_answers_decode(m.answers),
       supercoil_trajectory_session_low_decode(m.session_low),
       supercoil_trajectory_refusal_decode(m.refusal),
       supercoil_trajectory_playback_decode(m.playback), supercoil_trajectory_room_decode(m.room),
       unless<std::uint16_t>(65535, m.buffered_s, supercoil_trajectory_buffered_s_decode)});
}
inline Values boot(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_boot_unpack);
  return values({supercoil_boot_version_major_decode(m.version_major),
                 supercoil_boot_version_minor_decode(m.version_minor),
                 supercoil_boot_version_patch_decode(m.version_patch),
                 supercoil_boot_commit_decode(m.commit)});
}
inline Values joint(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_joint_unpack);
  // NOLINTNEXTLINE(bugprone-easily-swappable-parameters)
  const auto only = [&](int part, double value) { return m.part == part ? value : NAN; };
  return values(
      {supercoil_joint_part_decode(m.part),
       supercoil_joint_agonist_limited_decode(m.agonist_limited),
       supercoil_joint_agonist_slack_decode(m.agonist_slack),
       supercoil_joint_antagonist_limited_decode(m.antagonist_limited),
       supercoil_joint_antagonist_slack_decode(m.antagonist_slack),
       unless(-524288, m.angle_deg, supercoil_joint_angle_deg_decode),
       only(0, unless(-524288, m.reference_deg, supercoil_joint_reference_deg_decode)),
       only(0, unless(-32768, m.error_deg, supercoil_joint_error_deg_decode)),
       only(1, unless(-131072, m.effort_w, supercoil_joint_effort_w_decode)),
       only(1, unless(262143, m.co_contraction_w, supercoil_joint_co_contraction_w_decode)),
       only(2, unless(-32768, m.agonist_coldest_c, supercoil_joint_agonist_coldest_c_decode)),
       only(2, unless(-32768, m.agonist_hottest_c, supercoil_joint_agonist_hottest_c_decode)),
       only(3, unless(131071, m.agonist_applied_w, supercoil_joint_agonist_applied_w_decode)),
       only(3, unless(524287, m.agonist_resistance_ohm,
                      supercoil_joint_agonist_resistance_ohm_decode)),
       only(4, unless(-32768, m.antagonist_coldest_c, supercoil_joint_antagonist_coldest_c_decode)),
       only(4, unless(-32768, m.antagonist_hottest_c, supercoil_joint_antagonist_hottest_c_decode)),
       only(5, unless(131071, m.antagonist_applied_w, supercoil_joint_antagonist_applied_w_decode)),
       only(5, unless(524287, m.antagonist_resistance_ohm,
                      supercoil_joint_antagonist_resistance_ohm_decode))});
}
inline Values status(const hal::CanFrame& frame) {
  const auto m = unpacked(frame, supercoil_status_unpack);
  return values(
      {supercoil_status_state_decode(m.state), supercoil_status_mode_decode(m.mode),
       supercoil_status_fault_decode(m.fault), supercoil_status_limited_by_decode(m.limited_by),
       supercoil_status_probing_decode(m.probing), supercoil_status_trusted_decode(m.trusted),
       supercoil_status_limited_decode(m.limited), supercoil_status_leased_decode(m.leased),
       supercoil_status_controller_decode(m.controller),
       unless(255, m.progress, supercoil_status_progress_decode),
       supercoil_status_counter_decode(m.counter),
       supercoil_status_protocol_version_decode(m.protocol_version),
       supercoil_status_result_decode(m.result), supercoil_status_proof_off_decode(m.proof_off),
       supercoil_status_oscillated_decode(m.oscillated),
       supercoil_status_friction_decode(m.friction), supercoil_status_slack_decode(m.slack)});
}

struct CodecMessage {
  std::string_view name;
  std::uint16_t id;  ///< of node 1
  std::uint8_t length;
  Values (*read)(const hal::CanFrame& frame);
};

constexpr std::array<CodecMessage, 30> codec_messages{{
    {"Sync", SUPERCOIL_SYNC_FRAME_ID, SUPERCOIL_SYNC_LENGTH, sync},
    {"Knot", SUPERCOIL_KNOT_FRAME_ID, SUPERCOIL_KNOT_LENGTH, knot},
    {"Play", SUPERCOIL_PLAY_FRAME_ID, SUPERCOIL_PLAY_LENGTH, play},
    {"Trajectory", SUPERCOIL_TRAJECTORY_FRAME_ID, SUPERCOIL_TRAJECTORY_LENGTH, trajectory},
    {"Emergency", SUPERCOIL_EMERGENCY_FRAME_ID, SUPERCOIL_EMERGENCY_LENGTH, emergency},
    {"FirstCause", SUPERCOIL_FIRST_CAUSE_FRAME_ID, SUPERCOIL_FIRST_CAUSE_LENGTH, first_cause},
    {"Command", SUPERCOIL_COMMAND_FRAME_ID, SUPERCOIL_COMMAND_LENGTH, command},
    {"Acknowledge", SUPERCOIL_ACKNOWLEDGE_FRAME_ID, SUPERCOIL_ACKNOWLEDGE_LENGTH, acknowledge},
    {"Measurement", SUPERCOIL_MEASUREMENT_FRAME_ID, SUPERCOIL_MEASUREMENT_LENGTH, measurement},
    {"Tracking", SUPERCOIL_TRACKING_FRAME_ID, SUPERCOIL_TRACKING_LENGTH, tracking},
    {"Power", SUPERCOIL_POWER_FRAME_ID, SUPERCOIL_POWER_LENGTH, power},
    {"Heater", SUPERCOIL_HEATER_FRAME_ID, SUPERCOIL_HEATER_LENGTH, heater},
    {"Temperature", SUPERCOIL_TEMPERATURE_FRAME_ID, SUPERCOIL_TEMPERATURE_LENGTH, temperature},
    {"Estimate", SUPERCOIL_ESTIMATE_FRAME_ID, SUPERCOIL_ESTIMATE_LENGTH, estimate},
    {"Margin", SUPERCOIL_MARGIN_FRAME_ID, SUPERCOIL_MARGIN_LENGTH, margin},
    {"Limit", SUPERCOIL_LIMIT_FRAME_ID, SUPERCOIL_LIMIT_LENGTH, limit},
    {"Timing", SUPERCOIL_TIMING_FRAME_ID, SUPERCOIL_TIMING_LENGTH, timing},
    {"Gain", SUPERCOIL_GAIN_FRAME_ID, SUPERCOIL_GAIN_LENGTH, gain},
    {"RefusedValue", SUPERCOIL_REFUSED_VALUE_FRAME_ID, SUPERCOIL_REFUSED_VALUE_LENGTH,
     refused_value},
    {"Muscle", SUPERCOIL_MUSCLE_FRAME_ID, SUPERCOIL_MUSCLE_LENGTH, muscle},
    {"Setting", SUPERCOIL_SETTING_FRAME_ID, SUPERCOIL_SETTING_LENGTH, setting},
    {"SettingWrite", SUPERCOIL_SETTING_WRITE_FRAME_ID, SUPERCOIL_SETTING_WRITE_LENGTH,
     setting_write},
    {"SettingRead", SUPERCOIL_SETTING_READ_FRAME_ID, SUPERCOIL_SETTING_READ_LENGTH, setting_read},
    {"MuscleRead", SUPERCOIL_MUSCLE_READ_FRAME_ID, SUPERCOIL_MUSCLE_READ_LENGTH, muscle_read},
    {"Tuning", SUPERCOIL_TUNING_FRAME_ID, SUPERCOIL_TUNING_LENGTH, tuning},
    {"TuningWrite", SUPERCOIL_TUNING_WRITE_FRAME_ID, SUPERCOIL_TUNING_WRITE_LENGTH, tuning_write},
    {"TuningRead", SUPERCOIL_TUNING_READ_FRAME_ID, SUPERCOIL_TUNING_READ_LENGTH, tuning_read},
    {"Boot", SUPERCOIL_BOOT_FRAME_ID, SUPERCOIL_BOOT_LENGTH, boot},
    {"Joint", SUPERCOIL_JOINT_FRAME_ID, SUPERCOIL_JOINT_LENGTH, joint},
    {"Status", SUPERCOIL_STATUS_FRAME_ID, SUPERCOIL_STATUS_LENGTH, status},
}};

}  // namespace supercoil::test
