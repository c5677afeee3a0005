// A board's controllers with all their values, as text and JSON, for `tune` and the page.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <tl/expected.hpp>

#include "loop/tuner.hpp"

namespace supercoil::operating {

/// Of one tunable, in each set.
using TunableValues = std::array<double, tuning_set_names.size()>;
/// By place in control::tunables(); those that the controller has in some set.
using TunedValues = std::map<std::size_t, TunableValues>;

/// Asks the board for one value.
using AskTuning =
    std::function<tl::expected<double, std::string>(int place, std::size_t tunable, TuningSet set)>;

/// By the controllers' places. The error: no answer, or a board that cannot be tuned.
tl::expected<std::vector<TunedValues>, std::string> read_tuning(const AskTuning& ask);

/// By its name where it has one; "-": there is none.
std::string tuning_text(const control::Tunable& tunable, double value);
/// A number or a name; the error says what is allowed.
tl::expected<double, std::string> tuning_value(const control::Tunable& tunable,
                                               const std::string& text);

/// {"controllers": [{"controller": 0, "kind": {"prepared": "pi", …}, …}], "choices": {"kind": […]}}
nlohmann::ordered_json tuning_json(const std::vector<TunedValues>& controllers);

}  // namespace supercoil::operating
