// Any controller and estimator in closed loop with the paper's muscle and a noisy 16-bit sensor.
#pragma once

#include <optional>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "unit/control/support/muscle.hpp"

namespace supercoil::test {

/// 5, 15, 8 and 20 mm, 20 s each.
inline double paper_steps_m(double time_s) {
  constexpr std::array<double, 4> levels_m{0.005, 0.015, 0.008, 0.020};
  return levels_m[static_cast<std::size_t>(time_s / 20.0) % levels_m.size()];
}

struct NoisyLoop {
  static constexpr double step_s = 1e-3;

  control::ControllerSettings controller;
  std::optional<control::EstimatorSettings> estimator{};
  control::Estimate believed{};  ///< if settled, the controller has learned it before the start
  double noise_rms_m = 10e-6;
  double soft_from_s = 1e9;  ///< from this time on the stiffness is 12 N/m
  double (*reference_m)(double) = paper_sine_m;

  /// on_tick(time_s, true error in µm) at each tick.
  template <class OnTick>
  void run(double duration_s, OnTick on_tick) const {
    constexpr double count_m = 0.040 / 65536;
    control::Controller law(controller, step_s);
    std::optional<control::Estimator> learning;
    if (estimator) learning.emplace(*estimator, step_s);
    for (int k = 0; believed.settled && k < 30'000; ++k)
      law.learn(believed);
    boost::random::mt19937 source(1);
    boost::random::normal_distribution<double> noise(0.0, noise_rms_m);
    control::PhysicalParameters truth;
    Muscle muscle(truth, step_s);
    const control::PowerRange range;
    double power_W = 0.0;
    bool limited = false;
    for (long k = 0; k < std::lround(duration_s / step_s); ++k) {
      const double time_s = static_cast<double>(k) * step_s;
      if (k == std::lround(soft_from_s / step_s)) {
        truth.stiffness_N_per_m = 12.0;
        muscle.change(truth);
      }
      const double measured_m =
          std::nearbyint((muscle.position_m() + noise(source)) / count_m) * count_m;
      if (learning) {
        learning->step(measured_m, power_W);
        law.learn(*learning->estimate());
      }
      const auto out = law.step({.reference_m = reference_m(time_s),
                                 .position_m = measured_m,
                                 .applied_power_W = power_W,
                                 .limited = limited,
                                 .range = range});
      on_tick(time_s, 1e6 * (out.model_m - muscle.position_m()));
      power_W = range.clip(out.demanded_power_W);
      limited = power_W != out.demanded_power_W;
      muscle.step(power_W);
    }
  }

  /// Root mean square of the errors within each span [from, to), in µm.
  template <std::size_t N>
  std::array<double, N> rms_um(const std::array<std::array<double, 2>, N>& spans_s) const {
    std::array<double, N> squares{};
    std::array<double, N> counts{};
    double end_s = 0.0;
    for (const auto& span : spans_s)
      end_s = std::fmax(end_s, span[1]);
    run(end_s, [&](double time_s, double error_um) {
      for (std::size_t i = 0; i < N; ++i) {
        if (time_s < spans_s[i][0] || time_s >= spans_s[i][1]) continue;
        squares[i] += error_um * error_um;
        counts[i] += 1.0;
      }
    });
    for (std::size_t i = 0; i < N; ++i)
      squares[i] = std::sqrt(squares[i] / counts[i]);
    return squares;
  }
};

}  // namespace supercoil::test
