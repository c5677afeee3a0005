// Prints the names that the firmware has for the numbers it sends, as JSON: what the tables of
// values in the DBC must say.
#include <cstdio>
#include <exception>

#include <nlohmann/json.hpp>

#include "loop/snapshot.hpp"
#include "telemetry/joint_frame.hpp"
#include "telemetry/opcodes.hpp"
#include "telemetry/run_settings.hpp"
#include "telemetry/tuning_frames.hpp"

namespace {

using namespace supercoil;

template <std::size_t N>
nlohmann::ordered_json table(const std::array<std::string_view, N>& names) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < N; ++i)
    json[std::to_string(i)] = names[i];
  return json;
}

nlohmann::ordered_json settings() {
  nlohmann::ordered_json json;
  for (std::uint8_t i = 0; i < telemetry::run_settings; ++i)
    json[std::to_string(i)] = telemetry::run_setting_name(i);
  return json;
}

nlohmann::ordered_json tunables() {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < control::tunable_count; ++i)
    json[std::to_string(i)] = control::tunables()[i].name;
  json[std::to_string(telemetry::all_tunables)] = "all";
  return json;
}

nlohmann::ordered_json faults() {
  nlohmann::ordered_json json{{"0", name(Fault::none)}};
  for (const FaultInfo& fault : all_faults())
    json[std::to_string(static_cast<int>(fault.fault))] = fault.name;
  return json;
}

}  // namespace

int main() {
  try {
    const nlohmann::ordered_json json{{"state", table(state_names)},
                                      {"mode", table(mode_names)},
                                      {"fault", faults()},
                                      {"limited_by", table(limit_names)},
                                      {"refusal", table(refusal_names)},
                                      {"opcode", table(telemetry::opcode_names())},
                                      {"result", table(mode_result_names)},
                                      {"gain", table(control::gain_names)},
                                      {"setting", settings()},
                                      {"tunable", tunables()},
                                      {"set", table(tuning_set_names)},
                                      {"part", table(telemetry::joint_part_names)},
                                      {"version", telemetry::protocol_version}};
    std::puts(json.dump(1).c_str());
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
    return 1;
  }
  return 0;
}
