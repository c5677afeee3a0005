#include "supervisor/dither.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "supercoil/control/actuator/state_space.hpp"

namespace supercoil {

namespace {

constexpr double max_response_m = 20e-6;
constexpr double max_counts = 2.0;
/// Of the channel's maximum power.
constexpr double max_amplitude_ratio = 0.1;
/// 0.2 s is the mechanical answer of the paper's muscle; slower ones need longer halves. Halves
/// beyond usual_half_s are used only if no shorter one is decided in time: a slow dither is harder
/// to tell from drift.
constexpr std::array halves_s{0.2, 0.3, 0.5, 0.8, 1.2, 2.0, 3.5, 6.0};
constexpr double usual_half_s = 1.2;
/// Max motion, over the max answer, if friction lets go of the muscle during a long half.
constexpr double max_unheld_ratio = 4.0;
/// The longest run of a dither, in halves of at least usual_half_s.
constexpr double max_halves = 2.5;

/// For the longest half at 149 Hz, in steps of 6.7 ms.
constexpr std::size_t max_steps = 2250;

/// What a dither must achieve, and its limits.
struct Needs {
  double max_m;       ///< its peak
  double max_W;       ///< its amplitude
  double decisive_m;  ///< root of the sum of its squares, without its slow part
  double step_s;
};

/// Answer to a dither of one watt, from one pass of the linear model.
class UnitAnswer {
 public:
  UnitAnswer(const Needs& needs, const Dither& dither) : needs_(needs), dither_(dither) {}

  /// Runs for longest_s, or only for useful_s if it is not decided by then.
  void run(ExpectedMotion motion, double longest_s, double useful_s) {
    detectors::HighPass fast(dither_.corner_rad_per_s, needs_.step_s);
    const std::size_t steps = std::min(max_steps, steps_in(longest_s));
    const std::size_t useful = std::min(steps, steps_in(useful_s));
    double sum_m2 = 0.0;
    for (steps_ = 0; steps_ < steps && (steps_ != useful || is_decided(sum_m2)); ++steps_) {
      const double response_m = motion.step(dither_.sign(static_cast<int>(steps_)));
      const double fast_m = fast.step(response_m);
      peak_m_ = std::max(peak_m_, std::abs(response_m));
      sum_m2 += fast_m * fast_m;
      sums_m2_[steps_] = sum_m2;
    }
  }
  double peak_m() const { return peak_m_; }
  double amplitude_W() const { return std::min(needs_.max_m / peak_m_, needs_.max_W); }
  double decided_s() const {
    for (std::size_t i = 0; i < steps_; ++i) {
      if (is_decided(sums_m2_[i])) return static_cast<double>(i + 1) * needs_.step_s;
    }
    return INFINITY;
  }

 private:
  std::size_t steps_in(double time_s) const {
    const double steps = time_s / needs_.step_s;
    return steps < static_cast<double>(max_steps) ? static_cast<std::size_t>(steps) : max_steps;
  }
  bool is_decided(double sum_m2) const {
    return amplitude_W() * std::sqrt(sum_m2) >= needs_.decisive_m;
  }

  Needs needs_;
  Dither dither_;
  std::size_t steps_ = 0;
  double peak_m_ = 0.0;
  std::array<double, max_steps> sums_m2_;
};

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
  const Needs needs{max_m, max_amplitude_ratio * max_W,
                    detectors::Response::needed_deviations * sensor.noise_m, step_s};
  Dither best;
  for (const double half_s : halves_s) {
    const bool slow = half_s > usual_half_s;
    if (slow && best.decided_s <= in_time_s) break;
    Dither dither;
    dither.corner_rad_per_s *= std::min(1.0, usual_half_s / half_s);
    dither.half_steps = std::max(2, static_cast<int>(std::lround(half_s / step_s)));
    UnitAnswer answer(needs, dither);
    answer.run(motion, max_halves * std::max(usual_half_s, half_s),
               slow ? best.decided_s : INFINITY);
    dither.amplitude_W = answer.amplitude_W();
    const double unheld_m = dither.amplitude_W * answer.peak_m() / motion.response_ratio();
    if (slow && unheld_m > max_unheld_ratio * max_m) break;
    dither.decided_s = answer.decided_s();
    if (dither.decided_s < best.decided_s || dither.decided_s <= in_time_s) best = dither;
  }
  return best;
}

}  // namespace supercoil
