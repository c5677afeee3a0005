// What is known of a run before it: whether its reference can be followed, and how closely.
#pragma once

#include <optional>
#include <string>

#include "loop/promise.hpp"
#include "runner/reference_feasibility.hpp"
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

/// Determined once for all that uses it: it takes as long as some thousand ticks.
struct ScenarioForecast {
  explicit ScenarioForecast(const Scenario& scenario);

  BoardSettings board;                            ///< forecast_board_of()
  std::optional<ReferenceFeasibility> reference;  ///< empty: it follows no position
  std::optional<ScenarioPromise> promise;         ///< empty: neither, or can hold no travel
};

/// In words; empty: the reference itself has no promise.
std::string describe_promise(const std::optional<ScenarioPromise>& promise);

/// The rms error above which a run did not follow: far above what was promised, and a large part
/// of the motion (docs/simulation.md). motion_m: Motion::size_m().
double unfollowed_m(const std::optional<ScenarioPromise>& promise, double motion_m);

}  // namespace supercoil::host_sim
