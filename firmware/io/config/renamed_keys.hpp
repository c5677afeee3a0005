// Keys that had another name in an earlier version: the one place that knows them.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace supercoil::config {

/// A key that was renamed within its table.
struct RenamedKey {
  std::string_view table;  ///< the last tables of its path; empty at the top of a file
  std::string_view old_key;
  std::string_view key;
};

/// Keys that 0.1.0 named differently: board.toml, scenarios, and settings of a running board.
inline constexpr std::array<RenamedKey, 26> renamed_keys{{
    {"board", "telemetry_silence_ms", "telemetry_timeout_ms"},
    {"board", "can_off_ms", "can_bus_off_ms"},
    {"board", "can_passive_ms", "can_error_passive_ms"},
    {"supply", "lowest_V", "min_V"},
    {"supply", "highest_V", "max_V"},
    {"can", "most_load", "max_load"},
    {"channel.position", "lowest_m", "min_m"},
    {"channel.position", "highest_m", "max_m"},
    {"thermal", "lowest_mass_J_per_K", "min_mass_J_per_K"},
    {"thermal", "highest_mass_J_per_K", "max_mass_J_per_K"},
    {"thermal", "lowest_transfer_W_per_K", "min_transfer_W_per_K"},
    {"thermal", "highest_transfer_W_per_K", "max_transfer_W_per_K"},
    {"detectors", "fastest_m_per_s", "max_speed_m_per_s"},
    {"detectors", "least_resistance_Ohm", "min_resistance_Ohm"},
    {"detectors", "responding_part", "responding_ratio"},
    {"detectors", "responding_least_m", "responding_min_m"},
    {"detectors", "resistance_part", "resistance_ratio"},
    {"estimator", "lowest_part", "min_ratio"},
    {"estimator", "highest_part", "max_ratio"},
    {"estimator", "largest_bias_W", "max_bias_W"},
    {"", "trouble", "injected_fault"},
    {"operator", "wish", "action"},
    {"thermal", "mass_part", "mass_ratio"},
    {"thermal", "transfer_part", "transfer_ratio"},
    {"thermal", "power_part", "power_ratio"},
    {"setting", "most_power_W", "max_power_W"},
}};

/// The present name of a key; empty when it was not renamed. path: its table's as in messages, such
/// as channel[1].estimator[2].
std::string_view renamed_to(const std::string& path, std::string_view old_key);

/// "was renamed in 0.2.0: write can.max_load"; empty when it was not renamed.
std::string renamed_message(const std::string& path, std::string_view old_key);

}  // namespace supercoil::config
