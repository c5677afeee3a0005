#include "loop/support/identified_muscle.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "runner/summary.hpp"
#include "scenario/read_scenario.hpp"

namespace supercoil::test {

using namespace host_sim;

namespace {

/// Longer than identify ever takes.
constexpr double max_identify_s = 1300.0;

Scenario parsed(const std::string& text) {
  auto scenario = parse_scenario(text, "identify.toml");
  if (!scenario) throw std::runtime_error(config::to_text(scenario.error()));
  return *scenario;
}

control::PhysicalParameters muscle_of(const MuscleKind& kind) {
  return parsed("[plant]\n" + std::string(kind.plant)).start.plant.parameters;
}

/// The span of a quantity that is believed to be `believed_ratio` times the truth; no narrower than
/// the default span around the truth.
std::string span(double believed_ratio, double low, double high) {
  return "[" + std::to_string(std::min(1.0, low / believed_ratio)) + ", " +
         std::to_string(std::max(1.0, high / believed_ratio)) + "]\n";
}

std::string scenario_of(const MuscleKind& kind, int seed, double duration_s, Heat heat) {
  control::PhysicalParameters belief = muscle_of(kind);
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> factor(0.5, 1.5);
  std::string text = "simulation.seed = " + std::to_string(seed) +
                     "\nsimulation.duration_s = " + std::to_string(duration_s) +
                     "\noperator.action = 'rest'\n[plant]\n" + std::string(kind.plant) +
                     "\n[power]\nmax_W = " + std::to_string(kind.max_W) +
                     "\npwm_bits = 16\nsupply_V = " + (kind.max_W > 14.0 ? "24.0" : "12.0") +
                     "\n[muscle]\n";
  const control::PhysicalParameters truth = belief;
  for (const control::PhysicalRange& range : control::physical_ranges) {
    belief.*range.member *= factor(random);
    text += std::string(range.name) + " = " + std::to_string(belief.*range.member) + '\n';
  }
  if (heat == Heat::known) {
    const control::PhysicalParameters& b = belief;
    text += "[thermal]\nmass_ratio = " +
            span(b.thermal_mass_J_per_K / truth.thermal_mass_J_per_K, 0.75, 1.35) +
            "transfer_ratio = " +
            span(b.heat_transfer_W_per_K / truth.heat_transfer_W_per_K, 0.45, 2.2);
  }
  // heater_not_responding counts its windows from boot, so the start time is random.
  std::uniform_real_distribution<double> start_s(0.1, 20.1);
  text +=
      "[[event]]\nat_s = " + std::to_string(start_s(random)) + "\noperator.action = 'identify'\n";
  return text;
}

}  // namespace

Identified run_identify(const MuscleKind& kind, int seed, Heat heat) {
  const Scenario scenario = parsed(scenario_of(kind, seed, max_identify_s, heat));
  Simulation simulation(scenario);
  const Snapshot& snapshot = simulation.loop().channel(0).snapshot();
  Identified done;
  done.truth = muscle_of(kind);
  const double air_C = scenario.start.ambient.air_C;
  bool moved = false;
  bool started = false;
  double started_s = 0.0;
  while (!simulation.done()) {
    const TickRecord r = simulation.step();
    if (!started) started_s = r.time_s;
    started = started || snapshot.result == ModeResult::running;
    done.ended_s = r.time_s;
    done.took_s = r.time_s - started_s;
    done.fault = r.fault;
    done.hottest_C = std::max(done.hottest_C, air_C + r.temperature_rise_K);
    done.hottest_published_C = std::max(done.hottest_published_C, air_C + r.hottest_K);
    done.max_m = std::max(done.max_m, r.position_m);
    moved = moved || r.position_m > 0.001;
    if (moved) done.min_m = std::min(done.min_m, r.position_m);
    if (simulation.tick() % 10 == 0) {
      done.position_m.push_back(r.measured_m);
      done.power_W.push_back(r.applied_power_W);
    }
    if (started && snapshot.result != ModeResult::running) break;
  }
  done.result = snapshot.result;
  done.notes = snapshot.identify_notes;
  done.learned = simulation.learned();
  return done;
}

double tracking_after(const MuscleKind& kind, int seed) {
  const double identified_s = run_identify(kind, seed, Heat::known).ended_s;
  constexpr double turn = 6.283185307179586;
  const double period_s = turn / kind.sine_rad_per_s;
  const double start_s = std::ceil(identified_s) + 1.0;
  const double middle_m = 0.5 * (kind.sine_top_m + kind.sine_bottom_m);
  const std::string text =
      scenario_of(kind, seed, start_s + 6.0 * period_s, Heat::known) +
      "[controller]\nkind = 'learned_ff'\n[reference]\nkind = 'sine'\noffset_m = " +
      std::to_string(middle_m) + "\namplitude_m = " + std::to_string(kind.sine_top_m - middle_m) +
      "\nangular_frequency_rad_per_s = " + std::to_string(kind.sine_rad_per_s) +
      "\n[[event]]\nat_s = " + std::to_string(start_s) + "\noperator.action = 'track'\n";
  const Scenario scenario = parsed(text);
  Simulation simulation(scenario);
  Summary summary({start_s + 3.0 * period_s});
  while (!simulation.done())
    summary.add(simulation.step());
  return simulation.learned() ? summary.tracking().rms() : std::nan("");
}

}  // namespace supercoil::test
