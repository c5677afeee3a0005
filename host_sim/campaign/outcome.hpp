// The outcome of a run of a study.
#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <string>
#include <string_view>

#include "compare/measure.hpp"
#include "runner/summary.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim::campaign {

struct Quantity {
  std::string_view name;  ///< its unit is the last part
  std::string_view meaning;
};

/// Quantities that judge a run, in addition to compare's measures, which come first.
inline constexpr std::array<Quantity, 15> run_quantities{{
    {"tracking_rms_m", "error against the reference model within the window"},
    {"tracking_max_m", "largest error against the reference model within the window"},
    {"hottest_rise_K", "the highest true temperature of any of its muscles above the air"},
    {"hottest_C", "the highest true temperature of any of its muscles"},
    {"outside_interval_ticks", "ticks with the true temperature outside the firmware's bounds"},
    {"faults", "number of faults that latched"},
    {"not_armed", "1: the muscle was never armed"},
    {"oscillated", "1: the controller detected that its loop oscillated"},
    {"infeasible_ratio",
     "fraction of the position-following ticks at which the reference was infeasible"},
    {"not_found", "1: identify or calibrate found nothing"},
    {"gain_error_ratio",
     "relative error of the DC gain that identify found; not of joints, bundles"},
    {"cooling_error_ratio",
     "relative error of the thermal pole that identify found; not of joints, bundles"},
    {"promised_rms_m", "error promised for the first motion"},
    {"first_motion_rms_m", "rms error of the first motion in its last period"},
    {"promise_broken", "1: first_motion_rms_m exceeded promised_rms_m"},
}};

inline constexpr std::size_t quantity_count = compare::measures.size() + run_quantities.size();
constexpr Quantity quantity(std::size_t number) {
  constexpr std::size_t first = compare::measures.size();
  return number < first
             ? Quantity{compare::measures[number].name, compare::measures[number].meaning}
             : run_quantities[number - first];
}
/// By its name.
std::optional<std::size_t> find_quantity(std::string_view name);

struct Outcome {
  std::string refused;  ///< why the scenario was refused, without commas; empty: it ran
  std::string fault;    ///< the first; empty without
  /// In the order of `quantity`. NaN: not available for the run. Infinite: the muscle no longer
  /// followed, or never settled.
  std::array<double, quantity_count> values{};
};

/// Runs the scenario; empty when it was given up because of stop.
std::optional<Outcome> simulate(const Scenario& scenario, const Window& window,
                                const std::atomic<bool>& stop);

}  // namespace supercoil::host_sim::campaign
