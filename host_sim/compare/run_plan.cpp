#include "compare/run_plan.hpp"

#include <atomic>
#include <cstdint>
#include <optional>

#include "batch/in_parallel.hpp"
#include "runner/simulation.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::host_sim::compare {

namespace {

constexpr std::int64_t look_every_ticks = 4096;

/// Empty when it was given up.
std::optional<Result> simulate(const Case& planned, std::uint64_t seed,
                               const std::atomic<bool>& stop) {
  Scenario scenario = planned.scenario;
  scenario.seed = seed;
  Simulation simulation(scenario);
  Meters meters(scenario);
  Fault fault = Fault::none;
  while (!simulation.done()) {
    if (simulation.tick() % look_every_ticks == 0 && stop) return std::nullopt;
    const TickRecord& record = simulation.step();
    meters.add(record);
    if (fault == Fault::none) fault = record.fault;
    if (fault == Fault::none) fault = record.board_fault;
  }
  return Result{planned.definition, fault == Fault::none ? "" : std::string(name(fault)),
                meters.values()};
}

}  // namespace

void run_plan(const std::vector<Case>& cases, const std::vector<Run>& runs, unsigned jobs,
              const Listener& listener) {
  batch::in_parallel(
      runs.size(), jobs,
      [&](std::size_t number, const std::atomic<bool>& stop) -> batch::Handover {
        const Run& run = runs[number];
        const auto result = simulate(cases[run.case_index], run.seed, stop);
        if (!result) return {};
        return [&listener, &run, result = *result] { listener.ended(run, result); };
      },
      listener.stop);
}

}  // namespace supercoil::host_sim::compare
