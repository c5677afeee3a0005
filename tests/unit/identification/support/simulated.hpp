// Recordings of muscles that are known to the tests.
#pragma once

#include <random>

#include "supercoil/identification/comparison.hpp"

namespace supercoil::identification::test {

inline constexpr double full_W = 3.0;
inline constexpr double noise_m = 1e-5;

/// Different from the start of a fit.
inline Muscle other_muscle() {
  Muscle muscle;
  muscle.gain_m_per_W = 0.009;
  muscle.time_constant_s = 9.0;
  muscle.natural_frequency_rad_per_s = 7.0;
  muscle.damping_ratio = 0.4;
  muscle.rest_m = 0.003;
  return muscle;
}

/// Steps of 0 to max_W, each 2 to 12 s long; every third is a rest, and the second is max_W.
inline Samples random_steps(double duration_s, double max_W, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Samples samples;
  samples.step_s = 0.02;
  const auto count = static_cast<std::size_t>(duration_s / samples.step_s);
  for (int step = 0; samples.power_W.size() < count; ++step) {
    const double share = step == 1 ? 1.0 : unit(random);
    const double power_W = step % 3 == 0 ? 0.0 : max_W * share;
    const auto length = static_cast<std::size_t>((2.0 + 10.0 * unit(random)) / samples.step_s);
    samples.power_W.insert(samples.power_W.end(), length, power_W);
  }
  samples.power_W.resize(count);
  samples.position_m.assign(count, 0.0);
  return samples;
}

/// Its motion with white noise, where full_W counts.
inline void record(const Muscle& muscle, double noise_rms_m, unsigned seed, Samples& samples) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, noise_rms_m);
  samples.position_m = motion(muscle, samples, full_W, samples.size());
  for (double& position_m : samples.position_m)
    position_m += noise(random);
}

}  // namespace supercoil::identification::test
