// A board's controllers and estimators with all their values, as text and JSON, for `tune` and the
// page.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "supercoil/hal/error.hpp"

#include "loop/tuner.hpp"

namespace supercoil::operating {

/// What can be tuned.
enum class Tuned : std::uint8_t { controller, estimator };
constexpr std::string_view name(Tuned what) {
  return what == Tuned::controller ? "controller" : "estimator";
}
constexpr Tuned tuned_at(int place) {
  return place < static_cast<int>(first_estimator_place) ? Tuned::controller : Tuned::estimator;
}
/// Numbered as in Tuner. place: among controllers, or among estimators.
constexpr int place_of(Tuned what, std::size_t place) {
  return static_cast<int>(what == Tuned::controller ? place : first_estimator_place + place);
}

/// Values of one tunable, in each set.
using TunableValues = std::array<double, tuning_set_names.size()>;
/// By place in control::tunables(); only those with a value in some set.
using TunedValues = std::map<std::size_t, TunableValues>;

/// By their places.
struct TunedChannel {
  std::vector<TunedValues> controllers;
  std::vector<TunedValues> estimators;  ///< empty: the board is too old to tune them
};

/// Asks the board for one value; place: numbered as in Tuner.
using ReadTunable = std::function<Result<double>(int place, std::size_t tunable, TuningSet set)>;

/// The error: no answer, or a board that cannot be tuned.
Result<TunedChannel> read_tuning(const ReadTunable& read_value);
/// The kinds in use, by their places. The error: no answer.
Result<std::vector<std::string>> read_kinds(Tuned what, const ReadTunable& read_value);
/// Names of the values in a place's prepared set. place: numbered as in Tuner.
Result<std::vector<std::string>> read_names(int place, const ReadTunable& read_value);
/// {"controllers": ["mrac", …], "estimators": ["gradient", …]}: only the kinds in use, by their
/// places. The error: no answer.
Result<nlohmann::ordered_json> read_kinds(const ReadTunable& read_value);
/// Names of all values that it may have.
std::vector<std::string> tunable_names(Tuned what);

/// A named value as its name; "-": not available.
std::string tuning_text(Tuned what, const control::Tunable& tunable, double value);
/// A number or a name; the error says what is allowed.
Result<double> tuning_value(Tuned what, const control::Tunable& tunable, const std::string& text);

/// {"controllers": [{"controller": 0, "kind": {"prepared": "pi", …}, …}], "estimators":
/// [{"estimator": 0, …}], "choices": {"controllers": {"kind": […], …}, "estimators": {…}}}
nlohmann::ordered_json tuning_json(const TunedChannel& channel);

}  // namespace supercoil::operating
