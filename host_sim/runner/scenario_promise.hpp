// How closely a scenario's reference would be followed.
#pragma once

#include <optional>
#include <string>

#include "loop/promise.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// Of a muscle alone or against a spring, at the start: the error on its sine, or on the first
/// motion of `supercoil setup` where the reference is none, or none that the muscle can follow.
struct ScenarioPromise {
  Promise parts;
  bool of_own_controller = true;  ///< else the recommended one's
  bool of_reference = true;       ///< else of the first motion
  FirstMotion motion;
};
/// Empty: it follows no position, or can hold no travel.
std::optional<ScenarioPromise> scenario_promise(const Scenario& scenario);

/// In words; empty: there is none of the reference itself.
std::string describe_scenario_promise(const Scenario& scenario);

/// The rms error from which on a run did not follow: far above what was promised, and a large part
/// of the motion (docs/simulation.md). motion_m: Motion::size_m().
double unfollowed_m(const std::optional<ScenarioPromise>& promise, double motion_m);

}  // namespace supercoil::host_sim
