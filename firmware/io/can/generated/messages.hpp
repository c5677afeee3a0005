// Generated from firmware/io/can/supercoil.dbc by toolchain/generate-can. Do not edit.
#pragma once

#include "can/message.hpp"

namespace supercoil::can {

inline constexpr std::array<ValueName, 3> names_of_answers{{
    {0, "nothing"},
    {1, "knot"},
    {2, "play"},
}};

inline constexpr std::array<ValueName, 33> names_of_fault{{
    {0, "none"},
    {10, "sensor_out_of_range"},
    {11, "sensor_stale"},
    {12, "sensor_frozen"},
    {13, "sensor_jump"},
    {14, "sensors_disagree"},
    {20, "heater_open"},
    {21, "heater_short"},
    {22, "heater_stuck_on"},
    {23, "heater_not_responding"},
    {24, "duty_wrong"},
    {25, "line_failed"},
    {30, "over_temperature"},
    {31, "over_travel"},
    {32, "energy_budget_exceeded"},
    {33, "resistance_drift"},
    {34, "muscle_loose"},
    {40, "under_voltage"},
    {41, "over_voltage"},
    {42, "power_limit_exceeded"},
    {50, "overrun"},
    {51, "tick_late"},
    {52, "telemetry_dead"},
    {60, "command_timeout"},
    {61, "command_damaged"},
    {62, "command_not_allowed"},
    {63, "emergency_stop"},
    {70, "bus_off"},
    {71, "bus_error_passive"},
    {72, "node_conflict"},
    {80, "configuration_invalid"},
    {81, "controller_invalid"},
    {82, "self_test_failed"},
}};

inline constexpr std::array<ValueName, 16> names_of_gain{{
    {0, "none"},
    {1, "proportional"},
    {2, "integral"},
    {3, "derivative"},
    {4, "feedforward"},
    {5, "power_rate"},
    {6, "power"},
    {7, "position_rate"},
    {8, "position_lag"},
    {9, "position"},
    {10, "reference"},
    {11, "sigma"},
    {12, "feedforward_velocity"},
    {13, "feedforward_acceleration"},
    {14, "feedforward_jerk"},
    {15, "bias"},
}};

inline constexpr std::array<ValueName, 8> names_of_limited_by{{
    {0, "nothing"},
    {1, "minimum"},
    {2, "maximum"},
    {3, "slew"},
    {4, "temperature"},
    {5, "invalid"},
    {6, "cooling"},
    {7, "unproven"},
}};

inline constexpr std::array<ValueName, 7> names_of_mode{{
    {0, "rest"},
    {1, "position"},
    {2, "power"},
    {3, "identify"},
    {4, "calibrate"},
    {5, "joint"},
    {6, "bundle"},
}};

inline constexpr std::array<ValueName, 16> names_of_opcode{{
    {0, "compare"},
    {1, "arm"},
    {2, "disarm"},
    {3, "reset"},
    {4, "position"},
    {5, "power"},
    {6, "renew"},
    {7, "rest"},
    {8, "identify"},
    {9, "calibrate"},
    {10, "scale"},
    {11, "controller"},
    {12, "estimator"},
    {13, "store"},
    {14, "claim_of_version_3"},
    {15, "lease"},
}};

inline constexpr std::array<ValueName, 14> names_of_parameter{{
    {0, "theta1"},
    {1, "theta2"},
    {2, "theta3"},
    {3, "theta4"},
    {4, "thermal_mass"},
    {5, "heat_transfer"},
    {6, "stiffness"},
    {7, "damping"},
    {8, "bias"},
    {9, "theta1_deviation"},
    {10, "theta2_deviation"},
    {11, "theta3_deviation"},
    {12, "theta4_deviation"},
    {13, "bias_deviation"},
}};

inline constexpr std::array<ValueName, 6> names_of_part{{
    {0, "motion"},
    {1, "effort"},
    {2, "agonist_heat"},
    {3, "agonist_power"},
    {4, "antagonist_heat"},
    {5, "antagonist_power"},
}};

inline constexpr std::array<ValueName, 6> names_of_playback{{
    {0, "empty"},
    {1, "loaded"},
    {2, "waiting"},
    {3, "playing"},
    {4, "ended"},
    {5, "dry"},
}};

inline constexpr std::array<ValueName, 44> names_of_quantity{{
    {0, "thermal_mass_J_per_K"},
    {1, "heat_transfer_W_per_K"},
    {2, "stiffness_N_per_m"},
    {3, "damping_Ns_per_m"},
    {4, "moving_mass_kg"},
    {5, "force_per_kelvin_N_per_K"},
    {6, "cold_resistance_Ohm"},
    {7, "position_offset_m"},
    {8, "position_scale"},
    {9, "response_ratio"},
    {10, "theta1_deviation_ratio"},
    {11, "theta2_deviation_ratio"},
    {12, "theta3_deviation_ratio"},
    {13, "theta4_deviation_ratio"},
    {14, "unexplained_ratio"},
    {15, "configured_thermal_mass_J_per_K"},
    {16, "configured_heat_transfer_W_per_K"},
    {17, "configured_stiffness_N_per_m"},
    {18, "configured_damping_Ns_per_m"},
    {19, "configured_moving_mass_kg"},
    {20, "configured_force_per_kelvin_N_per_K"},
    {21, "configured_cold_resistance_Ohm"},
    {22, "joint_lever_m"},
    {23, "joint_other_node_offset"},
    {24, "joint_lever_first_rad"},
    {25, "joint_lever_last_rad"},
    {26, "joint_lever_1_m"},
    {27, "joint_lever_2_m"},
    {28, "joint_lever_3_m"},
    {29, "joint_lever_4_m"},
    {30, "joint_lever_5_m"},
    {31, "joint_lever_6_m"},
    {32, "joint_lever_7_m"},
    {33, "bundle_leader_node_offset"},
    {34, "min_set_point_m"},
    {35, "max_set_point_m"},
    {36, "identified_s"},
    {37, "configured_max_W"},
    {38, "configured_trip_C"},
    {39, "configured_min_mass_J_per_K"},
    {40, "configured_max_mass_J_per_K"},
    {41, "configured_min_transfer_W_per_K"},
    {42, "configured_max_transfer_W_per_K"},
    {43, "configured_max_time_constant_s"},
}};

inline constexpr std::array<ValueName, 16> names_of_refusal{{
    {0, "none"},
    {1, "wrong_state"},
    {2, "cause_persists"},
    {3, "no_edge"},
    {4, "not_ready"},
    {5, "busy"},
    {6, "out_of_range"},
    {7, "no_such_channel"},
    {8, "not_lease_holder"},
    {9, "no_lease"},
    {10, "wrong_counter"},
    {11, "queue_full"},
    {12, "claim_again"},
    {13, "protocol_mismatch"},
    {14, "unsuitable"},
    {15, "infeasible"},
}};

inline constexpr std::array<ValueName, 12> names_of_result{{
    {0, "none"},
    {1, "running"},
    {2, "found"},
    {3, "interrupted"},
    {4, "not_cold"},
    {5, "moved"},
    {6, "poor_fit"},
    {7, "uncertain"},
    {8, "implausible"},
    {9, "not_stored"},
    {10, "too_little_motion"},
    {11, "moved_backwards"},
}};

inline constexpr std::array<ValueName, 4> names_of_set{{
    {0, "prepared"},
    {1, "in_use"},
    {2, "configured"},
    {3, "stored"},
}};

inline constexpr std::array<ValueName, 15> names_of_setting{{
    {0, "max_power_W"},
    {1, "measurement_Hz"},
    {2, "tracking_Hz"},
    {3, "power_Hz"},
    {4, "heater_Hz"},
    {5, "temperature_Hz"},
    {6, "estimate_Hz"},
    {7, "margin_Hz"},
    {8, "limit_Hz"},
    {9, "timing_Hz"},
    {10, "status_Hz"},
    {11, "gain_Hz"},
    {12, "supply_gain"},
    {13, "current_gain"},
    {14, "sense_error_ratio"},
}};

inline constexpr std::array<ValueName, 4> names_of_state{{
    {0, "disarmed"},
    {1, "armed"},
    {2, "active"},
    {3, "fault"},
}};

inline constexpr std::array<ValueName, 50> names_of_tunable{{
    {0, "kind"},
    {1, "proportional_W_per_m"},
    {2, "integral_W_per_m_s"},
    {3, "derivative_Ws_per_m"},
    {4, "feedforward_W_per_m"},
    {5, "bandwidth_rad_per_s"},
    {6, "derivative_filter_rad_per_s"},
    {7, "follow_s"},
    {8, "forgetting_s"},
    {9, "learn"},
    {10, "period_s"},
    {11, "find_period"},
    {12, "filter_rad_per_s"},
    {13, "regression_rad_per_s"},
    {14, "change_W"},
    {15, "hold_s"},
    {16, "shape_reference"},
    {17, "slow_when_oscillating"},
    {18, "reference_model"},
    {19, "model_pole_1_rad_per_s"},
    {20, "model_pole_2_rad_per_s"},
    {21, "model_pole_3_rad_per_s"},
    {22, "adaptation_scale"},
    {23, "gain_1"},
    {24, "gain_2"},
    {25, "gain_3"},
    {26, "gain_4"},
    {27, "normalisation"},
    {28, "window_s"},
    {29, "min_ratio"},
    {30, "max_ratio"},
    {31, "max_bias_W"},
    {32, "position_noise_m"},
    {33, "trusted_error"},
    {34, "gain_5"},
    {35, "gain_6"},
    {36, "sigma_gain"},
    {37, "damping"},
    {38, "alpha_1"},
    {39, "alpha_2"},
    {40, "lambda_1"},
    {41, "lambda_2"},
    {42, "p0_rad_per_s"},
    {43, "p1_rad_per_s"},
    {44, "q0_rad_per_s"},
    {45, "freeze_when_limited"},
    {46, "sigma_modification"},
    {47, "dead_zone_W"},
    {48, "adapt_bandwidth"},
    {255, "all"},
}};

inline constexpr std::array<ValueName, 3> names_of_when{{
    {0, "at_once"},
    {1, "at_sync"},
    {2, "never"},
}};

inline constexpr std::array<SignalInfo, 3> signals_of_Sync{{
    {"crc", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"sync", "", 8, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"master_time_s", "s", 16, 48, Raw::unsigned_integer, 1e-06, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 3> signals_of_Emergency{{
    {"fault", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_fault},
    {"state", "", 8, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_state},
    {"board_time_s", "s", 16, 48, Raw::unsigned_integer, 1e-06, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 2> signals_of_FirstCause{{
    {"measured", "", 0, 32, Raw::floating, 1.0, no_value, always, {}},
    {"limit", "", 32, 32, Raw::floating, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 5> signals_of_Knot{{
    {"crc", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"counter", "", 8, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"after_s", "s", 12, 12, Raw::unsigned_integer, 0.001, 4095, always, {}},
    {"position_m", "m", 24, 24, Raw::signed_integer, 1e-07, -8388608, always, {}},
    {"velocity_m_per_s", "m/s", 48, 16, Raw::signed_integer, 1e-05, -32768, always, {}},
}};

inline constexpr std::array<SignalInfo, 6> signals_of_Play{{
    {"crc", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"counter", "", 8, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"when", "", 12, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_when},
    {"session", "", 16, 16, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"sync", "", 32, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"after_s", "s", 40, 24, Raw::unsigned_integer, 1e-05, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 8> signals_of_Trajectory{{
    {"crc", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"counter", "", 8, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"answers", "", 12, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_answers},
    {"session_low", "", 16, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"refusal", "", 24, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_refusal},
    {"playback", "", 32, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_playback},
    {"room", "", 40, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"buffered_s", "s", 48, 16, Raw::unsigned_integer, 0.01, 65535, always, {}},
}};

inline constexpr std::array<SignalInfo, 3> signals_of_TuningRead{{
    {"place", "", 0, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"set", "", 4, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_set},
    {"tunable", "", 8, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_tunable},
}};

inline constexpr std::array<SignalInfo, 5> signals_of_Command{{
    {"crc", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"counter", "", 8, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"opcode", "", 12, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_opcode},
    {"session", "", 16, 16, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"value", "", 32, 32, Raw::floating, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 6> signals_of_Acknowledge{{
    {"crc", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"counter", "", 8, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"opcode", "", 12, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_opcode},
    {"session", "", 16, 16, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"refusal", "", 32, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_refusal},
    {"granted", "", 40, 16, Raw::unsigned_integer, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 3> signals_of_Measurement{{
    {"position_m", "m", 0, 24, Raw::signed_integer, 1e-07, -8388608, always, {}},
    {"resistance_Ohm", "Ohm", 24, 24, Raw::unsigned_integer, 0.001, 16777215, always, {}},
    {"resistance_age_s", "s", 48, 16, Raw::unsigned_integer, 0.01, 65535, always, {}},
}};

inline constexpr std::array<SignalInfo, 3> signals_of_Tracking{{
    {"reference_m", "m", 0, 24, Raw::signed_integer, 1e-07, -8388608, always, {}},
    {"model_m", "m", 24, 24, Raw::signed_integer, 1e-07, -8388608, always, {}},
    {"error_m", "m", 48, 16, Raw::signed_integer, 1e-06, -32768, always, {}},
}};

inline constexpr std::array<SignalInfo, 4> signals_of_Power{{
    {"demanded_W", "W", 0, 24, Raw::signed_integer, 0.0002, -8388608, always, {}},
    {"applied_W", "W", 24, 24, Raw::signed_integer, 0.0002, -8388608, always, {}},
    {"limited_by", "", 48, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_limited_by},
    {"limited", "", 52, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 3> signals_of_Heater{{
    {"supply_V", "V", 0, 16, Raw::unsigned_integer, 0.001, 65535, always, {}},
    {"current_A", "A", 16, 24, Raw::signed_integer, 1e-05, -8388608, always, {}},
    {"duty", "", 40, 16, Raw::unsigned_integer, 2e-05, 65535, always, {}},
}};

inline constexpr std::array<SignalInfo, 2> signals_of_Temperature{{
    {"coldest_C", "degC", 0, 16, Raw::signed_integer, 0.01, -32768, always, {}},
    {"hottest_C", "degC", 16, 16, Raw::signed_integer, 0.01, -32768, always, {}},
}};

inline constexpr std::array<SignalInfo, 18> signals_of_Estimate{{
    {"parameter", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_parameter},
    {"trusted", "", 8, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"identify_notes", "", 9, 7, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"error_bound", "", 16, 16, Raw::unsigned_integer, 0.0001, 65535, always, {}},
    {"theta1", "m", 32, 32, Raw::floating, 1.0, no_value, 0, {}},
    {"theta2", "W s2/m", 32, 32, Raw::floating, 1.0, no_value, 1, {}},
    {"theta3", "W s/m", 32, 32, Raw::floating, 1.0, no_value, 2, {}},
    {"theta4", "W/m", 32, 32, Raw::floating, 1.0, no_value, 3, {}},
    {"thermal_mass_J_per_K", "J/K", 32, 32, Raw::floating, 1.0, no_value, 4, {}},
    {"heat_transfer_W_per_K", "W/K", 32, 32, Raw::floating, 1.0, no_value, 5, {}},
    {"stiffness_N_per_m", "N/m", 32, 32, Raw::floating, 1.0, no_value, 6, {}},
    {"damping_Ns_per_m", "Ns/m", 32, 32, Raw::floating, 1.0, no_value, 7, {}},
    {"bias_W", "W", 32, 32, Raw::floating, 1.0, no_value, 8, {}},
    {"theta1_deviation", "m", 32, 32, Raw::floating, 1.0, no_value, 9, {}},
    {"theta2_deviation", "W s2/m", 32, 32, Raw::floating, 1.0, no_value, 10, {}},
    {"theta3_deviation", "W s/m", 32, 32, Raw::floating, 1.0, no_value, 11, {}},
    {"theta4_deviation", "W/m", 32, 32, Raw::floating, 1.0, no_value, 12, {}},
    {"bias_deviation_W", "W", 32, 32, Raw::floating, 1.0, no_value, 13, {}},
}};

inline constexpr std::array<SignalInfo, 3> signals_of_Margin{{
    {"fault", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_fault},
    {"used", "", 8, 16, Raw::unsigned_integer, 0.001, 65535, always, {}},
    {"measured", "", 24, 32, Raw::floating, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 2> signals_of_Limit{{
    {"fault", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_fault},
    {"limit", "", 8, 32, Raw::floating, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 4> signals_of_Timing{{
    {"late_s", "s", 0, 20, Raw::unsigned_integer, 1e-07, 1048575, always, {}},
    {"execution_s", "s", 20, 20, Raw::unsigned_integer, 1e-07, 1048575, always, {}},
    {"overruns", "", 40, 12, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"dropped_frames", "", 52, 12, Raw::unsigned_integer, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 2> signals_of_Gain{{
    {"gain", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_gain},
    {"value", "", 8, 32, Raw::floating, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 2> signals_of_RefusedValue{{
    {"value", "", 0, 32, Raw::floating, 1.0, no_value, always, {}},
    {"nearest", "", 32, 32, Raw::floating, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 2> signals_of_Muscle{{
    {"quantity", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_quantity},
    {"value", "", 8, 32, Raw::floating, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 6> signals_of_Setting{{
    {"crc", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"counter", "", 8, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"setting", "", 12, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_setting},
    {"refusal", "", 16, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_refusal},
    {"session_low", "", 24, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"value", "", 32, 32, Raw::floating, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 5> signals_of_SettingWrite{{
    {"crc", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"counter", "", 8, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"setting", "", 12, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_setting},
    {"session", "", 16, 16, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"value", "", 32, 32, Raw::floating, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 1> signals_of_SettingRead{{
    {"setting", "", 0, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_setting},
}};

inline constexpr std::array<SignalInfo, 1> signals_of_MuscleRead{{
    {"quantity", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_quantity},
}};

inline constexpr std::array<SignalInfo, 7> signals_of_Tuning{{
    {"crc", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"counter", "", 8, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"place", "", 12, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"tunable", "", 16, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_tunable},
    {"refusal", "", 24, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_refusal},
    {"set", "", 28, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_set},
    {"value", "", 32, 32, Raw::floating, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 17> signals_of_Status{{
    {"state", "", 0, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_state},
    {"mode", "", 4, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_mode},
    {"fault", "", 8, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_fault},
    {"limited_by", "", 16, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_limited_by},
    {"probing", "", 20, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"trusted", "", 21, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"limited", "", 22, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"leased", "", 23, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"controller", "", 24, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"progress", "", 32, 8, Raw::unsigned_integer, 0.005, 255, always, {}},
    {"counter", "", 40, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"protocol_version", "", 48, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"result", "", 56, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_result},
    {"proof_off", "", 60, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"oscillated", "", 61, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"friction", "", 62, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"slack", "", 63, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 4> signals_of_Boot{{
    {"version_major", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"version_minor", "", 8, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"version_patch", "", 16, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"commit", "", 32, 28, Raw::unsigned_integer, 1.0, no_value, always, {}},
}};

inline constexpr std::array<SignalInfo, 18> signals_of_Joint{{
    {"part", "", 0, 4, Raw::unsigned_integer, 1.0, no_value, always, names_of_part},
    {"agonist_limited", "", 4, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"agonist_slack", "", 5, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"antagonist_limited", "", 6, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"antagonist_slack", "", 7, 1, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"angle_deg", "deg", 8, 20, Raw::signed_integer, 0.0005, -524288, always, {}},
    {"reference_deg", "deg", 28, 20, Raw::signed_integer, 0.0005, -524288, 0, {}},
    {"error_deg", "deg", 48, 16, Raw::signed_integer, 0.0005, -32768, 0, {}},
    {"effort_W", "W", 28, 18, Raw::signed_integer, 0.001, -131072, 1, {}},
    {"co_contraction_W", "W", 46, 18, Raw::unsigned_integer, 0.001, 262143, 1, {}},
    {"agonist_coldest_C", "degC", 28, 16, Raw::signed_integer, 0.01, -32768, 2, {}},
    {"agonist_hottest_C", "degC", 44, 16, Raw::signed_integer, 0.01, -32768, 2, {}},
    {"agonist_applied_W", "W", 28, 17, Raw::unsigned_integer, 0.001, 131071, 3, {}},
    {"agonist_resistance_Ohm", "Ohm", 45, 19, Raw::unsigned_integer, 0.01, 524287, 3, {}},
    {"antagonist_coldest_C", "degC", 28, 16, Raw::signed_integer, 0.01, -32768, 4, {}},
    {"antagonist_hottest_C", "degC", 44, 16, Raw::signed_integer, 0.01, -32768, 4, {}},
    {"antagonist_applied_W", "W", 28, 17, Raw::unsigned_integer, 0.001, 131071, 5, {}},
    {"antagonist_resistance_Ohm", "Ohm", 45, 19, Raw::unsigned_integer, 0.01, 524287, 5, {}},
}};

inline constexpr std::array<SignalInfo, 6> signals_of_TuningWrite{{
    {"crc", "", 0, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"counter", "", 8, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"place", "", 12, 4, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"tunable", "", 16, 8, Raw::unsigned_integer, 1.0, no_value, always, names_of_tunable},
    {"session_low", "", 24, 8, Raw::unsigned_integer, 1.0, no_value, always, {}},
    {"value", "", 32, 32, Raw::floating, 1.0, no_value, always, {}},
}};

namespace message {
inline constexpr MessageInfo sync{"Sync", 0x040, 8, 0, signals_of_Sync, true};
inline constexpr MessageInfo emergency{"Emergency", 0x080, 8, 0, signals_of_Emergency, false};
inline constexpr MessageInfo first_cause{"FirstCause", 0x0c0, 8, 0, signals_of_FirstCause, false};
inline constexpr MessageInfo knot{"Knot", 0x100, 8, 0, signals_of_Knot, true};
inline constexpr MessageInfo play{"Play", 0x140, 8, 0, signals_of_Play, true};
inline constexpr MessageInfo trajectory{"Trajectory", 0x180, 8, 0, signals_of_Trajectory, false};
inline constexpr MessageInfo tuning_read{"TuningRead", 0x1c0, 2, 0, signals_of_TuningRead, true};
inline constexpr MessageInfo command{"Command", 0x200, 8, 0, signals_of_Command, true};
inline constexpr MessageInfo acknowledge{"Acknowledge", 0x240, 7, 0, signals_of_Acknowledge, false};
inline constexpr MessageInfo measurement{"Measurement", 0x280, 8, 10, signals_of_Measurement, false};
inline constexpr MessageInfo tracking{"Tracking", 0x2c0, 8, 10, signals_of_Tracking, false};
inline constexpr MessageInfo power{"Power", 0x300, 7, 20, signals_of_Power, false};
inline constexpr MessageInfo heater{"Heater", 0x340, 7, 50, signals_of_Heater, false};
inline constexpr MessageInfo temperature{"Temperature", 0x380, 4, 100, signals_of_Temperature, false};
inline constexpr MessageInfo estimate{"Estimate", 0x3c0, 8, 100, signals_of_Estimate, false};
inline constexpr MessageInfo margin{"Margin", 0x400, 7, 50, signals_of_Margin, false};
inline constexpr MessageInfo limit{"Limit", 0x440, 5, 100, signals_of_Limit, false};
inline constexpr MessageInfo timing{"Timing", 0x480, 8, 100, signals_of_Timing, false};
inline constexpr MessageInfo gain{"Gain", 0x4c0, 5, 200, signals_of_Gain, false};
inline constexpr MessageInfo refused_value{"RefusedValue", 0x500, 8, 0, signals_of_RefusedValue, false};
inline constexpr MessageInfo muscle{"Muscle", 0x540, 5, 0, signals_of_Muscle, false};
inline constexpr MessageInfo setting{"Setting", 0x580, 8, 0, signals_of_Setting, false};
inline constexpr MessageInfo setting_write{"SettingWrite", 0x5c0, 8, 0, signals_of_SettingWrite, true};
inline constexpr MessageInfo setting_read{"SettingRead", 0x600, 1, 0, signals_of_SettingRead, true};
inline constexpr MessageInfo muscle_read{"MuscleRead", 0x680, 1, 0, signals_of_MuscleRead, true};
inline constexpr MessageInfo tuning{"Tuning", 0x640, 8, 0, signals_of_Tuning, false};
inline constexpr MessageInfo status{"Status", 0x700, 8, 100, signals_of_Status, false};
inline constexpr MessageInfo boot{"Boot", 0x740, 8, 1000, signals_of_Boot, false};
inline constexpr MessageInfo joint{"Joint", 0x780, 8, 20, signals_of_Joint, false};
inline constexpr MessageInfo tuning_write{"TuningWrite", 0x6c0, 8, 0, signals_of_TuningWrite, true};
}  // namespace message

/// In the order of the DBC.
inline constexpr std::array<MessageInfo, 30> all_messages{{
    message::sync,
    message::emergency,
    message::first_cause,
    message::knot,
    message::play,
    message::trajectory,
    message::tuning_read,
    message::command,
    message::acknowledge,
    message::measurement,
    message::tracking,
    message::power,
    message::heater,
    message::temperature,
    message::estimate,
    message::margin,
    message::limit,
    message::timing,
    message::gain,
    message::refused_value,
    message::muscle,
    message::setting,
    message::setting_write,
    message::setting_read,
    message::muscle_read,
    message::tuning,
    message::status,
    message::boot,
    message::joint,
    message::tuning_write,
}};

}  // namespace supercoil::can
