// How closely a scenario's reference would be followed.
#pragma once

#include <optional>
#include <string>

#include "loop/promise.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// For a muscle alone or against a spring, at the start: the error on its sine, or, if the
/// reference is no sine or not feasible, on the first motion of `supercoil setup`.
struct ScenarioPromise {
  Promise parts;
  bool of_own_controller = true;  ///< else the recommended one's
  bool of_reference = true;       ///< else of the first motion
  FirstMotion motion;
};
/// Empty: it follows no position, or can hold no travel.
std::optional<ScenarioPromise> scenario_promise(const Scenario& scenario);

/// In words; empty: the reference itself has no promise.
std::string describe_scenario_promise(const Scenario& scenario);

/// The rms error above which a run did not follow: far above what was promised, and a large part
/// of the motion (docs/simulation.md). motion_m: Motion::size_m().
double unfollowed_m(const std::optional<ScenarioPromise>& promise, double motion_m);

}  // namespace supercoil::host_sim
