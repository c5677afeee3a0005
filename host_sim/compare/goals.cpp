// The figures that the controllers were built to reach (docs/compare.md).
#include "compare/table.hpp"

namespace supercoil::host_sim::compare {

namespace {

struct Goal {
  std::string_view controller;
  std::string_view disturbance;
  std::string_view measure;
  double max;
};

constexpr double micro = 1e-6;

constexpr std::array<Goal, 46> goals{{
    {"learned_ff", "nominal", "steady_rms_m", 1.2 * micro},
    {"learned_ff", "steps", "steady_rms_m", 3.5 * micro},
    {"learned_ff", "stiffness", "after_rms_m", 3 * micro},
    {"learned_ff", "real", "steady_rms_m", 7 * micro},
    {"learned_ff", "real_hard", "steady_rms_m", 16 * micro},
    {"learned_ff", "real:steps", "steady_rms_m", 9 * micro},
    {"learned_ff", "real_hard:steps", "steady_rms_m", 13 * micro},
    {"learned_ff", "real_stiffness", "after_rms_m", 5 * micro},
    {"learned_ff", "real_hard_stiffness", "after_rms_m", 16 * micro},
    {"learned_ff", "force", "steady_rms_m", 7.5 * micro},
    {"learned_ff", "softening", "steady_rms_m", 7.5 * micro},
    {"learned_ff", "hysteresis", "steady_rms_m", 8 * micro},
    {"learned_ff", "creep", "steady_rms_m", 7.5 * micro},
    {"learned_ff", "convection", "steady_rms_m", 7.5 * micro},
    {"learned_ff", "lonely_stroke", "steady_rms_m", 7.5 * micro},
    {"learned_ff", "friction", "steady_rms_m", 26 * micro},
    {"learned_ff", "friction_2", "steady_rms_m", 150 * micro},
    {"learned_ff", "force:steps", "steady_rms_m", 6 * micro},
    {"learned_ff", "softening:steps", "steady_rms_m", 6 * micro},
    {"learned_ff", "hysteresis:steps", "steady_rms_m", 13 * micro},
    {"learned_ff", "creep:steps", "steady_rms_m", 6 * micro},
    {"learned_ff", "convection:steps", "steady_rms_m", 6 * micro},
    {"learned_ff", "friction:steps", "steady_rms_m", 20 * micro},
    {"learned_ff", "friction_2:steps", "steady_rms_m", 60 * micro},
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

std::optional<double> goal_of(const TableRow& row, std::string_view measure) {
  for (const Goal& goal : goals) {
    if (goal.controller == row.controller && goal.disturbance == row.disturbance &&
        goal.measure == measure) {
      return goal.max;
    }
  }
  return std::nullopt;
}

}  // namespace supercoil::host_sim::compare
