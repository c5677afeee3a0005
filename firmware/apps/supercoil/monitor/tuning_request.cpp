#include "apps/supercoil/monitor/tuning_request.hpp"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "apps/supercoil/monitor/command_request.hpp"
#include "apps/supercoil/tuning_table.hpp"
#include "telemetry/tuning_frames.hpp"

namespace supercoil::operating {

namespace {

using nlohmann::json;

Result<std::vector<TuningRequest::Value>> values_of(Tuned what, const json& given) {
  const std::vector<std::string> known = tunable_names(what);
  std::vector<TuningRequest::Value> values;
  for (const auto& [name, text] : given.items()) {
    const std::size_t tunable = control::tunable_named(name);
    if (std::ranges::find(known, name) == known.end())
      return failure("'" + name + "' cannot be tuned");
    if (!text.is_string()) return failure("the value of " + name + " must be text");
    const auto value = tuning_value(what, control::tunables()[tunable], text.get<std::string>());
    if (!value) return tl::unexpected(value.error());
    values.push_back({static_cast<std::uint8_t>(tunable), *value});
  }
  std::ranges::sort(values, {}, &TuningRequest::Value::tunable);
  return values;
}

std::optional<Tuned> tuned_at(const json& place) {
  constexpr int places = 4;
  constexpr int first_estimator = first_estimator_place;
  if (!place.is_number_integer()) return std::nullopt;
  if (place >= 0 && place < places) return Tuned::controller;
  if (place >= first_estimator && place < first_estimator + places) return Tuned::estimator;
  return std::nullopt;
}

}  // namespace

Result<TuningRequest> parse_tuning_request(const std::string& text) {
  const auto node = parse_node(text);
  if (!node) return tl::unexpected(node.error());
  const json read = json::parse(text);
  const auto place = read.find("place");
  const auto what = place != read.end() ? tuned_at(*place) : std::nullopt;
  if (!what) return failure("place must be 0 to 3, or from 8 an estimator's");
  const auto from = read.find("from");
  const auto set = from != read.end() && from->is_string()
                       ? std::ranges::find(tuning_set_names, from->get<std::string>())
                       : tuning_set_names.end();
  if (set == tuning_set_names.end())
    return failure("from must be prepared, in_use, configured or stored");
  const json given = read.value("values", json::object());
  if (!given.is_object()) return failure("values must be an object");
  auto values = values_of(*what, given);
  if (!values) return tl::unexpected(values.error());
  return TuningRequest{*node, place->get<std::uint8_t>(),
                       static_cast<TuningSet>(set - tuning_set_names.begin()), std::move(*values)};
}

ManualControl::Answer tune(ManualControl& control, const TuningRequest& request) {
  const auto prepare = [&](std::uint8_t tunable, double value) {
    return control.prepare({request.place, tunable, TuningSet::prepared}, value);
  };
  auto answer = prepare(telemetry::all_tunables, static_cast<double>(request.from));
  for (const TuningRequest::Value& one : request.values) {
    if (!answer || *answer != Refusal::none) return answer;
    answer = prepare(one.tunable, one.value);
  }
  if (!answer || *answer != Refusal::none) return answer;
  return control.ask(Verb::tune, request.place);
}

}  // namespace supercoil::operating
