// The forecast of a run: the same for `run` and `run --check`.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// Prints what the muscle can do, as the board believes it to be, where it rests, what is
/// recommended and promised, whether the reference can be followed, and what to change.
void print_forecast(const Scenario& scenario);

/// The same for programs.
nlohmann::ordered_json forecast_json(const Scenario& scenario);

}  // namespace supercoil::host_sim
