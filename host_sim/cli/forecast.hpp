// What a run will show, told before it: the same for `run` and `run --check`.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// What the muscle that is believed can do and where it rests, what is recommended and promised,
/// whether the reference can be followed, and what to change. On standard output.
void print_forecast(const Scenario& scenario);

/// The same for programs.
nlohmann::ordered_json forecast_json(const Scenario& scenario);

}  // namespace supercoil::host_sim
