#include "apps/supercoil/tuning_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

#include "text/nearest.hpp"

namespace supercoil::operating {

namespace {

using control::Tunable;
using control::TunableType;

std::vector<std::string> names_of(Tuned what, const Tunable& tunable) {
  std::vector<std::string> names;
  const auto add = [&](const auto& kinds) {
    for (const auto& [name, kind] : kinds)
      names.emplace_back(name);
  };
  if (tunable.type == TunableType::kind) {
    what == Tuned::controller ? add(control::controller_names) : add(control::estimator_names);
  } else if (tunable.type == TunableType::model) {
    names.emplace_back("poles");
    names.insert(names.end(), control::tunable_models.begin(), control::tunable_models.end());
  } else if (tunable.type == TunableType::flag) {
    names = {"false", "true"};
  }
  return names;
}

nlohmann::ordered_json as_json(Tuned what, const Tunable& tunable, double value) {
  if (std::isnan(value)) return nullptr;
  if (tunable.type == TunableType::flag) return value != 0.0;
  if (names_of(what, tunable).empty()) return value;
  return tuning_text(what, tunable, value);
}

/// Skips values that it cannot have: every value takes four questions.
bool may_have(Tuned what, const Tunable& tunable) {
  return what == Tuned::controller ? tunable.controllers_have() : tunable.estimators_have();
}

/// Empty: nothing is at this place.
Result<TunedValues> read_place(Tuned what, std::size_t place, const ReadTunable& read_value) {
  TunedValues result;
  for (std::size_t i = 0; i < control::tunable_count; ++i) {
    if (!may_have(what, control::tunables()[i])) continue;
    TunableValues values{};
    for (std::size_t set = 0; set < values.size(); ++set) {
      const auto value = read_value(place_of(what, place), i, static_cast<TuningSet>(set));
      if (!value) return tl::unexpected(value.error());
      values[set] = *value;
    }
    const bool has = !std::ranges::all_of(values, [](double value) { return std::isnan(value); });
    if (has) result.emplace(i, values);
    if (result.empty()) break;
  }
  return result;
}

Result<std::vector<TunedValues>> read_places(Tuned what, std::size_t places,
                                             const ReadTunable& read_value) {
  std::vector<TunedValues> all;
  for (std::size_t place = 0; place < places; ++place) {
    auto result = read_place(what, place, read_value);
    if (!result) return tl::unexpected(result.error());
    if (result->empty()) break;
    all.push_back(std::move(*result));
  }
  return all;
}

nlohmann::ordered_json places_json(Tuned what, const std::vector<TunedValues>& all) {
  nlohmann::ordered_json result = nlohmann::ordered_json::array();
  for (const TunedValues& one : all) {
    nlohmann::ordered_json values{{name(what), result.size()}};
    for (const auto& [place, of_sets] : one) {
      const Tunable& tunable = control::tunables()[place];
      nlohmann::ordered_json sets;
      for (std::size_t set = 0; set < of_sets.size(); ++set)
        sets[std::string(tuning_set_names[set])] = as_json(what, tunable, of_sets[set]);
      values[std::string(tunable.name)] = sets;
    }
    result.push_back(values);
  }
  return result;
}

nlohmann::ordered_json choices_json(Tuned what) {
  nlohmann::ordered_json choices;
  for (const Tunable& tunable : control::tunables()) {
    if (const auto names = names_of(what, tunable); may_have(what, tunable) && !names.empty())
      choices[std::string(tunable.name)] = names;
  }
  return choices;
}

}  // namespace

Result<TunedChannel> read_tuning(const ReadTunable& read_value) {
  const board::StoredTuning tuned;
  auto controllers = read_places(Tuned::controller, tuned.controllers.size(), read_value);
  if (!controllers) return tl::unexpected(controllers.error());
  if (controllers->empty()) return failure("this board cannot be tuned");
  auto estimators = read_places(Tuned::estimator, tuned.estimators.size(), read_value);
  if (!estimators) return tl::unexpected(estimators.error());
  return TunedChannel{std::move(*controllers), std::move(*estimators)};
}

Result<std::vector<std::string>> read_kinds(Tuned what, const ReadTunable& read_value) {
  constexpr std::size_t kind = 0;
  const board::StoredTuning tuned;
  const std::size_t places =
      what == Tuned::controller ? tuned.controllers.size() : tuned.estimators.size();
  std::vector<std::string> kinds;
  while (kinds.size() < places) {
    const auto value = read_value(place_of(what, kinds.size()), kind, TuningSet::in_use);
    if (!value) return tl::unexpected(value.error());
    if (std::isnan(*value)) break;
    kinds.push_back(tuning_text(what, control::tunables()[kind], *value));
  }
  return kinds;
}

Result<nlohmann::ordered_json> read_kinds(const ReadTunable& read_value) {
  nlohmann::ordered_json result;
  for (const auto& [what, key] :
       {std::pair{Tuned::controller, "controllers"}, std::pair{Tuned::estimator, "estimators"}}) {
    const auto kinds = read_kinds(what, read_value);
    if (!kinds) return tl::unexpected(kinds.error());
    result[key] = *kinds;
  }
  return result;
}

Result<std::vector<std::string>> read_names(int place, const ReadTunable& read_value) {
  std::vector<std::string> names;
  for (const std::string& name : tunable_names(tuned_at(place))) {
    const auto value = read_value(place, control::tunable_named(name), TuningSet::prepared);
    if (!value) return tl::unexpected(value.error());
    if (!std::isnan(*value)) names.push_back(name);
  }
  return names;
}

std::vector<std::string> tunable_names(Tuned what) {
  std::vector<std::string> names;
  for (const Tunable& tunable : control::tunables()) {
    if (may_have(what, tunable)) names.emplace_back(tunable.name);
  }
  return names;
}

std::string tuning_text(Tuned what, const Tunable& tunable, double value) {
  if (std::isnan(value)) return "-";
  const auto names = names_of(what, tunable);
  if (value >= 0.0 && value < static_cast<double>(names.size()))
    return names[static_cast<std::size_t>(value)];
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.7g", value);
  return text.data();
}

Result<double> tuning_value(Tuned what, const Tunable& tunable, const std::string& text) {
  const auto names = names_of(what, tunable);
  const auto named = std::ranges::find(names, text);
  if (named != names.end()) return static_cast<double>(named - names.begin());
  double value = NAN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  if (names.empty() && is_number && tunable.in_range(value)) return value;
  std::array<char, 64> range{};
  std::snprintf(range.data(), range.size(), "must be %g to %g", tunable.min, tunable.max);
  return failure(
      std::string(tunable.name) + (text.empty() ? ": has no value: " : " = " + text + ": ") +
      (names.empty() ? std::string(range.data()) : suggestion_or_all(text, names, "there are")));
}

nlohmann::ordered_json tuning_json(const TunedChannel& channel) {
  return {{"controllers", places_json(Tuned::controller, channel.controllers)},
          {"estimators", places_json(Tuned::estimator, channel.estimators)},
          {"choices",
           {{"controllers", choices_json(Tuned::controller)},
            {"estimators", choices_json(Tuned::estimator)}}}};
}

}  // namespace supercoil::operating
