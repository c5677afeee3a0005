// What g++ counts for toolchain/profile-guided: built-in scenarios with their traces, some runs of
// the studies, the paper, and the comparison of estimators. Reads no clock, so that builds of one
// commit have the same counts.
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "campaign/draws.hpp"
#include "campaign/results.hpp"
#include "campaign/study.hpp"
#include "compare/measure.hpp"
#include "estimators/outcome.hpp"
#include "paper/reproduction.hpp"
#include "report/trace_writer.hpp"
#include "runner/simulation.hpp"
#include "runner/summary.hpp"
#include "scenario/builtin.hpp"
#include "scenario/read_scenario.hpp"

namespace {

using namespace supercoil::host_sim;

/// Campaigns write no traces.
enum class Trace { none, csv, npy };

bool run(const Scenario& scenario, Trace format) {
  Simulation simulation(scenario);
  compare::Meters meters(scenario);
  Summary summary{Window()};
  std::unique_ptr<TraceWriter> trace;
  if (format != Trace::none) {
    const TraceFormat file = format == Trace::csv ? TraceFormat::csv : TraceFormat::npy;
    trace = write_trace(trace_file(file), file, 1, &scenario.start);
  }
  while (!simulation.done()) {
    const TickRecord& record = simulation.step();
    meters.add(record);
    summary.add(record);
    if (trace) trace->add(record, simulation.estimate());
  }
  return !trace || trace->finish();
}

bool run_scenarios() {
  constexpr double endless_s = 3600.0;  // those that wait for commands
  for (const BuiltinScenario& builtin : builtin_scenarios()) {
    const auto scenario = read_scenario(std::string(builtin.name));
    if (!scenario) return false;
    if (scenario->duration_s > endless_s) continue;
    for (const Trace format : {Trace::none, Trace::csv, Trace::npy}) {
      if (!run(*scenario, format)) return false;
    }
  }
  return true;
}

bool try_estimators() {
  const std::atomic<bool> stop = false;
  for (const estimators::ContenderKind& contender : estimators::contenders) {
    for (const estimators::Trial& trial : estimators::trials) {
      if (!estimators::run(contender, trial, 1, stop)) return false;
    }
  }
  return true;
}

bool run_studies() {
  constexpr std::size_t runs = 4;
  const std::atomic<bool> stop = false;
  for (const BuiltinScenario& builtin : campaign::builtin_studies()) {
    const auto study = campaign::read_study(std::string(builtin.name));
    if (!study) return false;
    const campaign::Draws draws(*study);
    for (std::size_t number = 0; number < runs * study->contenders.size(); ++number) {
      const campaign::Key key{number / study->contenders.size(), number % study->contenders.size()};
      if (!campaign::carry_out(*study, draws, key, stop)) return false;
    }
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: supercoil-profile-runs FOLDER   (for its traces)\n", stderr);
    return 2;
  }
  std::filesystem::current_path(argv[1]);
  paper::reproduce([](double) {});
  if (run_scenarios() && run_studies() && try_estimators()) return 0;
  std::fputs("supercoil-profile-runs: not everything that is built in runs\n", stderr);
  return 1;
}
