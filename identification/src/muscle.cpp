#include "supercoil/identification/muscle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "supercoil/control/hysteresis/play.hpp"
#include "supercoil/control/linear/discretize.hpp"

namespace supercoil::identification {

namespace {

constexpr int plays = 5;
/// Above this share of full power a muscle counts as heated.
constexpr double min_heated_fraction = 0.02;

control::FirstOrderHold<2, 1> mechanics(const Muscle& m, double step_s) {
  const double w = m.natural_frequency_rad_per_s;
  control::Matrix<double, 2> a;
  a << 0.0, 1.0, -w * w, -2.0 * m.damping_ratio * w;
  return control::first_order_hold<2, 1>(a, control::Vector<double, 2>{0.0, w * w}, step_s);
}

/// The state after a step whose input is a parabola, 0 at both ends and 1 in the middle: four
/// thirds of that of a triangle.
control::Vector<double, 2> parabola(const Muscle& m, double step_s) {
  const auto half = mechanics(m, 0.5 * step_s);
  return 4.0 / 3.0 * (half.transition * half.end + half.start);
}

/// Heat, plays and the input of the mechanics.
class Drive {
 public:
  Drive(const Muscle& muscle, double full_W, double step_s)
      : m_(muscle), full_W_(full_W), step_s_(step_s), u_(muscle.start_W) {
    for (std::size_t i = 0; i < plays; ++i) {
      play_[i].set_radius(0.5 * muscle.play_range_W * static_cast<double>(i + 1) / plays);
      play_[i].rest_at(muscle.start_W);
    }
  }

  void heat(double power_W) {
    const double transferred = transfer(power_W);
    if (transferred != last_transfer_) {
      last_transfer_ = transferred;
      kept_ = std::exp(-transferred * step_s_ / m_.time_constant_s);
    }
    const double rest_W = power_W / transferred;
    const double before = u_;
    u_ = rest_W + (u_ - rest_W) * kept_;
    bulge_W_ = (before - rest_W) * (std::sqrt(kept_) - 0.5 * (1.0 + kept_));
    heat_J_ += 0.5 * (before + u_) * step_s_;
    max_power_W_ = std::max(max_power_W_, u_);
    if (m_.play_ratio <= 0.0) return;
    for (control::Play& play : play_)
      play.step(u_);
  }

  /// Where it would come to rest, relative to the rest length.
  double position_m() const {
    double u = u_;
    if (m_.play_ratio > 0.0) {
      double sum = 0.0;
      for (const control::Play& play : play_)
        sum += play.output();
      u = (1.0 - m_.play_ratio) * u + m_.play_ratio * sum / plays;
    }
    if (m_.transformed_W > 0.0) {
      const auto done = [&](double at) {
        return 1.0 / (1.0 + std::exp(-(at - m_.transformation_W) / m_.transformed_W));
      };
      return m_.gain_m_per_W * full_W_ * (done(u) - done(0.0));
    }
    return m_.gain_m_per_W * u * (1.0 + 0.5 * (m_.force_ratio - 1.0) * u / full_W_);
  }

  /// By how much it was off a straight line in the middle of the last step.
  double bulge_m() const {
    if (m_.transformed_W > 0.0) return 0.0;
    return m_.gain_m_per_W * bulge_W_ * (1.0 + (m_.force_ratio - 1.0) * u_ / full_W_);
  }

  double rest_m(double time_s) const {
    const double first = std::clamp(max_power_W_ / m_.lonely_stroke_W, 0.0, 1.0);
    return m_.rest_m + m_.drift_m_per_s * time_s + m_.heat_drift_m_per_J * heat_J_ -
           m_.lonely_stroke_m * first;
  }

 private:
  double transfer(double power_W) const {
    const double warm = 1.0 + (m_.transfer_ratio - 1.0) * std::max(0.0, u_ / full_W_);
    return std::max(0.02, warm) * (power_W > min_heated_fraction * full_W_ ? m_.heated_ratio : 1.0);
  }

  const Muscle& m_;
  double full_W_;
  double step_s_;
  double u_;
  double last_transfer_ = 0.0;
  double kept_ = 0.0;  // share of the difference from rest that is left after a step
  double bulge_W_ = 0.0;
  double heat_J_ = 0.0;
  double max_power_W_ = 0.0;
  std::array<control::Play, plays> play_{};
};

}  // namespace

std::vector<double> motion(const Muscle& muscle, const Samples& samples, double full_W,
                           std::size_t count) {
  const auto hold = mechanics(muscle, samples.step_s);
  const control::Vector<double, 2> bulged = parabola(muscle, samples.step_s);
  Drive drive(muscle, full_W, samples.step_s);
  const double late = std::exp(-samples.step_s / muscle.creep_s);
  double input = drive.position_m();
  control::Vector<double, 2> state{input + muscle.start_offset_m, muscle.start_m_per_s};
  double crept = state[0];
  std::vector<double> result(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double time_s = static_cast<double>(k) * samples.step_s;
    result[k] =
        drive.rest_m(time_s) + (1.0 - muscle.creep_ratio) * state[0] + muscle.creep_ratio * crept;
    drive.heat(samples.power_W[k]);
    const double next = drive.position_m();
    state =
        (hold.transition * state + hold.start * input + hold.end * next + bulged * drive.bulge_m())
            .eval();
    crept = state[0] + (crept - state[0]) * late;
    input = next;
  }
  return result;
}

}  // namespace supercoil::identification
