// A tick of the simulated muscle alone. `real` at 4 substeps must cost at most three linear ticks.
#include "plant/plant.hpp"

#include <benchmark/benchmark.h>

#include "plant/presets.hpp"

namespace {

using namespace supercoil::host_sim;

void run_plant(benchmark::State& state, const PresetMuscle& muscle) {
  Plant plant(muscle.parameters, muscle.effects, 1e-3);
  unsigned tick = 0;
  for (auto _ : state) {
    plant.step((++tick & 1023U) < 400U ? 4.0 : 0.5);
    benchmark::DoNotOptimize(plant);
  }
}

void plant_paper(benchmark::State& state) {
  run_plant(state, preset_muscle(MusclePreset::paper));
}
void plant_real(benchmark::State& state) {
  run_plant(state, preset_muscle(MusclePreset::real));
}
void plant_real_with_friction(benchmark::State& state) {
  PresetMuscle muscle = preset_muscle(MusclePreset::real);
  muscle.effects.friction_ratio = 0.005;
  run_plant(state, muscle);
}
BENCHMARK(plant_paper);
BENCHMARK(plant_real);
BENCHMARK(plant_real_with_friction);

}  // namespace
