// The whole simulation, without a trace: ticks and simulated seconds a second.
#include "runner/simulation.hpp"

#include <cmath>
#include <string>

#include <benchmark/benchmark.h>

#include "scenario/read_scenario.hpp"

namespace {

using namespace supercoil::host_sim;

/// The budget at 1 kHz, one channel: 3,000 × real time or more. The boot is simulated like the
/// rest: 15 s, after which the scenario begins.
void scenario(benchmark::State& state, const std::string& name) {
  const auto read = read_scenario(name);
  if (!read) {
    state.SkipWithError("the scenario is not in order");
    return;
  }
  double simulated_s = 0.0;
  long ticks = 0;
  for (auto _ : state) {
    Simulation simulation(*read);
    while (!simulation.done())
      benchmark::DoNotOptimize(simulation.step());
    const double boot_s = supercoil::hal::seconds(simulation.start());
    simulated_s += boot_s + read->duration_s;
    ticks += std::lround(boot_s / read->step_s()) + simulation.ticks();
  }
  state.counters["x_real_time"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
  state.counters["ticks"] =
      benchmark::Counter(static_cast<double>(ticks), benchmark::Counter::kIsRate);
}

BENCHMARK_CAPTURE(scenario, sine_mrac_gradient, "sine")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scenario, sine_real_muscle, "real")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scenario, identify_gradient, "identify")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scenario, fixed_point, "fixed-point")->Unit(benchmark::kMillisecond);

}  // namespace
