// The figures that the controllers were built to reach (docs/compare.md).
#include "compare/table.hpp"

namespace supercoil::host_sim::compare {

namespace {

struct Goal {
  std::string_view controller;
  std::string_view disturbance;
  std::string_view measure;
  double most;
};

constexpr double micro = 1e-6;

constexpr std::array<Goal, 22> goals{{
    {"adaptive_ff", "nominal", "steady_rms_m", 2 * micro},
    {"adaptive_ff", "stiffness", "steady_rms_m", 2 * micro},
    {"adaptive_ff", "stiffness", "after_rms_m", 3 * micro},
    {"adaptive_ff", "stiffness", "peak_m", 1000 * micro},
    {"adaptive_ff", "stiffness", "settling_s", 1.0},
    {"adaptive_ff", "heat_transfer_up", "after_rms_m", 3 * micro},
    {"adaptive_ff", "mass", "after_rms_m", 3 * micro},
    {"adaptive_ff", "power_up", "after_rms_m", 3 * micro},
    {"adaptive_ff", "power_down", "after_rms_m", 3 * micro},
    {"adaptive_ff", "load", "after_rms_m", 3 * micro},
    {"adaptive_ff", "steps", "steady_rms_m", 5 * micro},
    {"adaptive_ff", "far_start", "learned_rms_m", 10 * micro},
    {"mrac-c", "nominal", "steady_rms_m", 5 * micro},
    {"mrac-c", "stiffness", "changed_rms_m", 400 * micro},
    {"mrac-c", "stiffness", "after_rms_m", 15 * micro},
    {"mrac-c", "steps", "steady_rms_m", 15 * micro},
    {"mrac-c", "steps", "after_rms_m", 20 * micro},
    {"mrac-a", "nominal", "steady_rms_m", 15 * micro},
    {"mrac-a", "stiffness", "steady_rms_m", 15 * micro},
    {"mrac-a", "stiffness", "after_rms_m", 12 * micro},
    {"mrac-a", "steps", "steady_rms_m", 50 * micro},
    {"mrac-a", "steps", "after_rms_m", 100 * micro},
}};

}  // namespace

std::optional<double> goal_of(const Row& row, std::string_view measure) {
  for (const Goal& goal : goals) {
    if (goal.controller == row.controller && goal.disturbance == row.disturbance &&
        goal.measure == measure) {
      return goal.most;
    }
  }
  return std::nullopt;
}

}  // namespace supercoil::host_sim::compare
