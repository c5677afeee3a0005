#include "apps/supercoil/tuning_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "text/nearest.hpp"

namespace supercoil::operating {

namespace {

using control::Tunable;
using control::TunableType;

std::vector<std::string> names_of(const Tunable& tunable) {
  std::vector<std::string> names;
  if (tunable.type == TunableType::kind) {
    for (const auto& [name, kind] : control::controller_names)
      names.emplace_back(name);
  } else if (tunable.type == TunableType::model) {
    names.emplace_back("poles");
    names.insert(names.end(), control::tunable_models.begin(), control::tunable_models.end());
  } else if (tunable.type == TunableType::flag) {
    names = {"false", "true"};
  }
  return names;
}

nlohmann::ordered_json as_json(const Tunable& tunable, double value) {
  if (std::isnan(value)) return nullptr;
  if (tunable.type == TunableType::flag) return value != 0.0;
  if (names_of(tunable).empty()) return value;
  return tuning_text(tunable, value);
}

/// Empty: there is no such controller.
tl::expected<TunedValues, std::string> read_controller(int place, const AskTuning& ask) {
  TunedValues controller;
  for (std::size_t i = 0; i < control::tunable_count; ++i) {
    TunableValues values{};
    for (std::size_t set = 0; set < values.size(); ++set) {
      const auto value = ask(place, i, static_cast<TuningSet>(set));
      if (!value) return tl::unexpected(value.error());
      values[set] = *value;
    }
    const bool has = !std::ranges::all_of(values, [](double value) { return std::isnan(value); });
    if (has) controller.emplace(i, values);
    if (controller.empty()) break;
  }
  return controller;
}

}  // namespace

tl::expected<std::vector<TunedValues>, std::string> read_tuning(const AskTuning& ask) {
  constexpr int places = 4;
  std::vector<TunedValues> controllers;
  for (int place = 0; place < places; ++place) {
    auto controller = read_controller(place, ask);
    if (!controller) return tl::unexpected(controller.error());
    if (controller->empty()) break;
    controllers.push_back(std::move(*controller));
  }
  if (controllers.empty()) return tl::unexpected<std::string>("this board cannot be tuned");
  return controllers;
}

std::string tuning_text(const Tunable& tunable, double value) {
  if (std::isnan(value)) return "-";
  const auto names = names_of(tunable);
  if (value >= 0.0 && value < static_cast<double>(names.size()))
    return names[static_cast<std::size_t>(value)];
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.7g", value);
  return text.data();
}

tl::expected<double, std::string> tuning_value(const Tunable& tunable, const std::string& text) {
  const auto names = names_of(tunable);
  const auto named = std::ranges::find(names, text);
  if (named != names.end()) return static_cast<double>(named - names.begin());
  double value = NAN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  if (names.empty() && is_number && tunable.in_range(value)) return value;
  std::array<char, 64> range{};
  std::snprintf(range.data(), range.size(), "must be %g to %g", tunable.lowest, tunable.highest);
  return tl::unexpected(
      std::string(tunable.name) + " = " + text + ": " +
      (names.empty() ? std::string(range.data()) : meant_or_all(text, names, "there are")));
}

nlohmann::ordered_json tuning_json(const std::vector<TunedValues>& controllers) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const TunedValues& controller : controllers) {
    nlohmann::ordered_json told{{"controller", all.size()}};
    for (const auto& [place, values] : controller) {
      const Tunable& tunable = control::tunables()[place];
      nlohmann::ordered_json sets;
      for (std::size_t set = 0; set < values.size(); ++set)
        sets[std::string(tuning_set_names[set])] = as_json(tunable, values[set]);
      told[std::string(tunable.name)] = sets;
    }
    all.push_back(told);
  }
  nlohmann::ordered_json choices;
  for (const Tunable& tunable : control::tunables()) {
    if (const auto names = names_of(tunable); !names.empty())
      choices[std::string(tunable.name)] = names;
  }
  return {{"controllers", all}, {"choices", choices}};
}

}  // namespace supercoil::operating
