// One step of every estimator and controller in every arithmetic.
#include <array>
#include <cmath>

#include <benchmark/benchmark.h>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

namespace {

using namespace supercoil::control;

constexpr double step_s = 1e-3;

/// A slow motion of the right size, so that no branch and no denormal number flatters the figure.
class Signals {
 public:
  Signals() {
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const double t = 6.283185307 * static_cast<double>(i) / static_cast<double>(table_.size());
      table_[i] = {0.011 + 0.009 * std::sin(t), 0.011 + 0.009 * std::sin(t - 0.01),
                   1.8 + 1.5 * std::sin(t + 0.3)};
    }
  }
  struct Sample {
    double reference_m, position_m, power_W;
  };
  const Sample& next() { return table_[++at_ % table_.size()]; }

 private:
  std::array<Sample, 4096> table_{};
  std::size_t at_ = 0;
};

void controller(benchmark::State& state, ControllerKind kind, Arithmetic arithmetic) {
  ControllerSettings settings;
  settings.kind = kind;
  settings.arithmetic = arithmetic;
  settings.mrac = *mrac_preset("a");
  Controller under_test(settings, step_s);
  Signals signals;
  for (auto _ : state) {
    const auto& s = signals.next();
    ControllerInput input{s.reference_m, 0.0, s.position_m, s.power_W, false};
    benchmark::DoNotOptimize(under_test.step(input));
  }
}

void estimator(benchmark::State& state, EstimatorKind kind, Arithmetic arithmetic) {
  EstimatorSettings settings;
  settings.kind = kind;
  settings.arithmetic = arithmetic;
  Estimator under_test(settings, step_s);
  Signals signals;
  for (auto _ : state) {
    const auto& s = signals.next();
    under_test.step(s.position_m, s.power_W);
    benchmark::ClobberMemory();
  }
}

/// The budget: 100 ns or less in double.
void mrac_and_gradient(benchmark::State& state, Arithmetic arithmetic) {
  ControllerSettings controller_settings;
  controller_settings.arithmetic = arithmetic;
  controller_settings.mrac = *mrac_preset("a");
  Controller control(controller_settings, step_s);
  EstimatorSettings estimator_settings;
  estimator_settings.arithmetic = arithmetic;
  Estimator estimate(estimator_settings, step_s);
  Signals signals;
  for (auto _ : state) {
    const auto& s = signals.next();
    estimate.step(s.position_m, s.power_W);
    ControllerInput input{s.reference_m, 0.0, s.position_m, s.power_W, false};
    benchmark::DoNotOptimize(control.step(input));
  }
}

constexpr auto float64 = Arithmetic::float64;
constexpr auto float32 = Arithmetic::float32;
constexpr auto q8_24 = Arithmetic::q8_24;

BENCHMARK_CAPTURE(controller, pi_double, ControllerKind::pi, float64);
BENCHMARK_CAPTURE(controller, pi_float, ControllerKind::pi, float32);
BENCHMARK_CAPTURE(controller, pi_q8_24, ControllerKind::pi, q8_24);
BENCHMARK_CAPTURE(controller, pd_ff_double, ControllerKind::pd_ff, float64);
BENCHMARK_CAPTURE(controller, pd_ff_float, ControllerKind::pd_ff, float32);
BENCHMARK_CAPTURE(controller, pd_ff_q8_24, ControllerKind::pd_ff, q8_24);
BENCHMARK_CAPTURE(controller, mrac_double, ControllerKind::mrac, float64);
BENCHMARK_CAPTURE(controller, mrac_float, ControllerKind::mrac, float32);
BENCHMARK_CAPTURE(controller, mrac_q8_24, ControllerKind::mrac, q8_24);
BENCHMARK_CAPTURE(controller, mrac_ls_double, ControllerKind::mrac_ls, float64);
BENCHMARK_CAPTURE(controller, mrac_ls_float, ControllerKind::mrac_ls, float32);
BENCHMARK_CAPTURE(controller, adaptive_ff_double, ControllerKind::adaptive_ff, float64);
BENCHMARK_CAPTURE(controller, adaptive_ff_float, ControllerKind::adaptive_ff, float32);
BENCHMARK_CAPTURE(controller, adaptive_ff_q8_24, ControllerKind::adaptive_ff, q8_24);
BENCHMARK_CAPTURE(controller, learned_ff_double, ControllerKind::learned_ff, float64);
BENCHMARK_CAPTURE(estimator, gradient_double, EstimatorKind::gradient, float64);
BENCHMARK_CAPTURE(estimator, gradient_float, EstimatorKind::gradient, float32);
BENCHMARK_CAPTURE(estimator, gradient_q8_24, EstimatorKind::gradient, q8_24);
BENCHMARK_CAPTURE(estimator, least_squares_double, EstimatorKind::least_squares, float64);
BENCHMARK_CAPTURE(estimator, least_squares_float, EstimatorKind::least_squares, float32);
BENCHMARK_CAPTURE(mrac_and_gradient, double, float64);
BENCHMARK_CAPTURE(mrac_and_gradient, float, float32);
BENCHMARK_CAPTURE(mrac_and_gradient, q8_24, q8_24);

}  // namespace
