#include "campaign/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "runner/simulation.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::host_sim::campaign {

namespace {

constexpr std::int64_t poll_every_ticks = 4096;

/// 1 if the identify or calibrate that was requested found nothing; NaN if none was requested.
double not_found(const Scenario& scenario, const Simulation& simulation) {
  const auto is_mode = [](OperatorAction action) {
    return action == OperatorAction::identify || action == OperatorAction::calibrate;
  };
  const bool requested = is_mode(scenario.start.action) ||
                         std::ranges::any_of(scenario.events, [&](const Event& event) {
                           return is_mode(event.conditions.action);
                         });
  if (!requested) return NAN;
  return simulation.learned() ? 0.0 : 1.0;
}

/// A muscle that moves alone, as identify found it and as it then was.
struct FoundMuscle {
  board::Identification identification;
  control::PhysicalParameters found;
  control::PhysicalParameters actual;
};

/// Relative error of a muscle's property that identify found; NaN if it found nothing.
template <class Property>
double found_error_ratio(const std::optional<FoundMuscle>& muscle, Property property) {
  if (!muscle) return NAN;
  return std::abs(property(muscle->found) / property(muscle->actual) - 1.0);
}

/// Keeps in `muscle` what identify finds from now on. What it finds of a joint or a bundle is not
/// [plant]'s muscle.
void keep_found(Simulation& simulation, std::optional<FoundMuscle>& muscle) {
  const Conditions& c = simulation.conditions();
  if (c.joint || !c.companions.empty()) return;
  simulation.on_learned([&](std::size_t, const board::LearnedUpdate& learned) {
    if (!learned || !learned->identification.found()) return;
    // A calibration repeats what was found before.
    if (muscle && learned->identification == muscle->identification) return;
    muscle = FoundMuscle{learned->identification, learned->muscle,
                         simulation.conditions().plant.parameters};
  });
}

/// NaN if nothing was promised, or no first motion was completed.
double promise_broken(double promised_rms_m, double rms_m) {
  if (std::isnan(promised_rms_m) || std::isnan(rms_m)) return NAN;
  return rms_m <= promised_rms_m ? 0.0 : 1.0;
}

}  // namespace

std::optional<std::size_t> find_quantity(std::string_view name) {
  for (std::size_t i = 0; i < quantity_count; ++i) {
    if (quantity(i).name == name) return i;
  }
  return std::nullopt;
}

std::optional<Outcome> simulate(const Scenario& scenario, const Window& window,
                                const std::atomic<bool>& stop) {
  Simulation simulation(scenario);
  compare::Meters meters(scenario);
  Summary summary(window);
  std::optional<FoundMuscle> found;
  keep_found(simulation, found);
  double max_rise_K = 0.0;
  double max_C = -std::numeric_limits<double>::infinity();
  while (!simulation.done()) {
    if (simulation.tick() % poll_every_ticks == 0 && stop) return std::nullopt;
    const TickRecord& record = simulation.step();
    meters.add(record);
    summary.add(record);
    const double rise_K = hottest_rise_K(record);
    max_rise_K = std::fmax(max_rise_K, rise_K);
    max_C = std::fmax(max_C, rise_K + simulation.conditions().ambient.air_C);
  }
  const bool followed = summary.tracking().count() > 0;
  Outcome outcome;
  if (!summary.faults().empty()) outcome.fault = name(summary.faults().front().fault);
  const auto measured = meters.values();
  const auto& motion = simulation.first_motion();
  const double promised_rms_m = motion ? motion->promised_rms_m() : NAN;
  const double first_motion_rms_m = motion ? motion->rms_m() : NAN;
  const std::array<double, run_quantities.size()> others{
      followed ? summary.tracking().rms() : NAN,
      followed ? summary.tracking().max() : NAN,
      max_rise_K,
      max_C,
      static_cast<double>(summary.outside_interval_ticks()),
      static_cast<double>(summary.faults().size()),
      summary.armed() ? 0.0 : 1.0,
      std::isnan(summary.oscillated_at_s()) ? 0.0 : 1.0,
      summary.infeasible() != nullptr ? summary.infeasible()->ratio() : NAN,
      not_found(scenario, simulation),
      found_error_ratio(found, [](const auto& muscle) { return muscle.dc_gain_m_per_W(); }),
      found_error_ratio(found, [](const auto& muscle) { return muscle.thermal_pole_rad_per_s(); }),
      promised_rms_m,
      first_motion_rms_m,
      promise_broken(promised_rms_m, first_motion_rms_m),
  };
  const auto rest = std::ranges::copy(measured, outcome.values.begin()).out;
  std::ranges::copy(others, rest);
  return outcome;
}

}  // namespace supercoil::host_sim::campaign
