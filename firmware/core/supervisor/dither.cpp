#include "supervisor/dither.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "supercoil/control/actuator/state_space.hpp"

namespace supercoil {

namespace {

constexpr double max_response_m = 20e-6;
constexpr double max_counts = 2.0;
/// Of the channel's greatest power.
constexpr double max_amplitude_ratio = 0.1;
/// 0.2 s is the mechanical answer of the paper's muscle; slower ones need longer halves. Beyond
/// usual_half_s only where none is decided in time: a slow dither is the harder to tell from a
/// drift.
constexpr std::array halves_s{0.2, 0.3, 0.5, 0.8, 1.2, 2.0, 3.5, 6.0};
constexpr double usual_half_s = 1.2;
/// Of a response as large as it may be, where friction lets go of the muscle during a long half.
constexpr double max_unheld_ratio = 4.0;
/// What takes longer is no dither; of its half.
constexpr double max_halves = 2.5;

double peak_response_m(ExpectedMotion motion, const Dither& dither, int steps) {
  double peak_m = 0.0;
  for (int i = 0; i < steps; ++i)
    peak_m = std::max(peak_m, std::abs(motion.step(dither.sign(i))));
  return peak_m;
}

double decided_s(ExpectedMotion motion, const Dither& dither, const SensorStep& sensor, int steps,
                 double step_s) {
  detectors::HighPass fast(dither.corner_rad_per_s, step_s);
  const double needed_m = detectors::Response::needed_deviations * sensor.noise_m;
  double sum_m2 = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double response_m = fast.step(motion.step(dither.amplitude_W * dither.sign(i)));
    sum_m2 += response_m * response_m;
    if (sum_m2 >= needed_m * needed_m) return (i + 1) * step_s;
  }
  return INFINITY;
}

}  // namespace

ExpectedMotion::ExpectedMotion(const control::PhysicalParameters& muscle, double step_s,
                               double response_ratio)
    : response_ratio_(response_ratio) {
  const control::ActuatorStateSpace system = control::state_space(muscle);
  discrete_ = control::zero_order_hold<3, 2>(system.a, system.b, step_s);
}

Dither dither_for(const ExpectedMotion& motion, const SensorStep& sensor, double max_W,
                  double in_time_s, double step_s) {
  const double max_m = std::max(max_response_m, max_counts * sensor.count_m);
  Dither best;
  for (const double half_s : halves_s) {
    if (half_s > usual_half_s && best.decided_s <= in_time_s) break;
    const double longest_s = max_halves * std::max(usual_half_s, half_s);
    const int steps = static_cast<int>(longest_s / step_s);
    Dither dither;
    dither.corner_rad_per_s *= std::min(1.0, usual_half_s / half_s);
    dither.half_steps = std::max(2, static_cast<int>(std::lround(half_s / step_s)));
    const double per_W_m = peak_response_m(motion, dither, steps);
    dither.amplitude_W = std::min(max_m / per_W_m, max_amplitude_ratio * max_W);
    const double unheld_m = dither.amplitude_W * per_W_m / motion.response_ratio();
    if (half_s > usual_half_s && unheld_m > max_unheld_ratio * max_m) break;
    dither.decided_s = decided_s(motion, dither, sensor, steps, step_s);
    if (dither.decided_s < best.decided_s || dither.decided_s <= in_time_s) best = dither;
  }
  return best;
}

}  // namespace supercoil
