// supercoil setting: values that may be changed on a running board until it starts again.
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "supercoil/control/tracking/tunable.hpp"

#include "apps/supercoil/bus/bus_name.hpp"
#include "apps/supercoil/bus/commander.hpp"
#include "apps/supercoil/commands.hpp"
#include "config/renamed_keys.hpp"
#include "telemetry/run_settings.hpp"
#include "text/nearest.hpp"
#include "text/number_text.hpp"
#include "text/refusal_words.hpp"

namespace supercoil::operating {

namespace {

std::vector<std::string> all_names() {
  std::vector<std::string> all;
  for (std::uint8_t i = 0; i < telemetry::run_settings; ++i)
    all.push_back(telemetry::run_setting_name(i));
  return all;
}

std::optional<std::uint8_t> setting_of(const std::string& name) {
  for (std::uint8_t i = 0; i < telemetry::run_settings; ++i) {
    if (telemetry::run_setting_name(i) == name) return i;
  }
  return std::nullopt;
}

void print_setting(const can_client::Master::Setting& answer, bool json) {
  const std::string name = telemetry::run_setting_name(answer.setting);
  if (json) {
    const nlohmann::ordered_json report{
        {"setting", name}, {"value", answer.value}, {"refusal", supercoil::name(answer.refusal)}};
    std::printf("%s\n", report.dump().c_str());
  } else if (!std::isnan(answer.value)) {
    std::printf("%s = %.7g\n", name.c_str(), answer.value);
  }
}

/// The range after an out-of-range value. nearest: would have been obeyed; NaN: not reported.
std::string range_of_refused(const can_client::Master::Setting& answer, double value,
                             double nearest) {
  using telemetry::Message;
  if (answer.setting >= telemetry::supply_gain)
    return "; it is read-only: supercoil doctor --compare-senses determines it";
  if (std::isnan(answer.value)) return "; the first node of its board sends that message";
  const auto allowed = [](double min_value, double max_value) {
    return "; " + number_text(min_value, 7) + " to " + number_text(max_value, 7) + " are in range";
  };
  constexpr double max_Hz = telemetry::max_rate(INFINITY);
  const char* as_far = ", up to its ticks a second, as far as its bus has room";
  if (answer.setting == 0) return value > nearest ? allowed(0.0, nearest) : "";
  if (answer.setting == 1 + static_cast<std::uint8_t>(Message::status))
    return allowed(telemetry::min_status_Hz, max_Hz) + as_far;
  return "; 0, for never, and " + allowed(telemetry::min_rate_Hz, max_Hz).substr(2) + as_far;
}

/// Suggests what was meant, also of another command.
std::string unknown_setting_text(const SettingOptions& options) {
  const std::string& written = options.name;
  if (const auto renamed = config::renamed_to("setting", written); !renamed.empty())
    return "was renamed in 0.2.0: write " + std::string(renamed);
  const std::size_t equals = written.find('=');
  const std::string name = written.substr(0, equals);
  if (equals != std::string::npos && setting_of(name))
    return "is not a setting; write " + name + " " + written.substr(equals + 1);
  if (control::tunable_named(name) == control::tunable_count)
    return "is not a setting; " + suggestion_or_all(name, all_names(), "there are");
  const std::string value = options.value ? number_text(*options.value, 9) : "VALUE";
  return "is tuned: supercoil tune " + std::to_string(options.node) + " " + name + "=" + value +
         " --can " + options.can;
}

int read_or_write(Commander& node, std::uint8_t setting, const SettingOptions& options) {
  const auto answer = options.value ? node.write(setting, *options.value) : node.read(setting);
  if (!answer) return refuse(options.json, exit_failed, answer.error().text());
  print_setting(*answer, options.json);
  if (answer->refusal == Refusal::none) return exit_done;
  const bool out = answer->refusal == Refusal::out_of_range;
  const double nearest = out ? node.nearest() : NAN;
  const std::string range =
      out ? range_of_refused(*answer, options.value.value_or(NAN), nearest) : "";
  return fail(exit_failed,
              options.name + ": " + answer_with_reason({answer->refusal, nearest}) + range);
}

/// Prints the settings that this node has: the board's own belong to its first node.
int print_all(Commander& node, bool json) {
  for (std::uint8_t i = 0; i < telemetry::run_settings; ++i) {
    const auto answer = node.read(i);
    if (!answer) return refuse(json, exit_failed, answer.error().text());
    if (answer->refusal == Refusal::none) print_setting(*answer, json);
  }
  return exit_done;
}

}  // namespace

int setting_command(const SettingOptions& options) {
  const auto setting = setting_of(options.name);
  if (!options.name.empty() && !setting) {
    return refuse(options.json, exit_wrong_input,
                  "'" + options.name + "' " + unknown_setting_text(options));
  }
  const auto id = static_cast<std::uint8_t>(options.node);
  auto bus = open_bus(options.can, can_client::answer_ids(id));
  if (!bus) return refuse(options.json, exit_failed, bus.error().text());
  Commander node(std::move(*bus), id);
  const int status =
      setting ? read_or_write(node, *setting, options) : print_all(node, options.json);
  node.release();
  return status;
}

}  // namespace supercoil::operating
