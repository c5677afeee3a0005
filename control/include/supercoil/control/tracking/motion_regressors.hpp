// What a muscle's power depends on along its reference motion, beyond the linear equation.
#pragma once

#include <array>

#include "supercoil/control/estimation/parametric_model.hpp"
#include "supercoil/control/hysteresis/play.hpp"
#include "supercoil/control/tracking/reference_model.hpp"

namespace supercoil::control {

/// The regressors of P = wᵀψ, all in watts. x, v, a, j are position, velocity, acceleration and
/// jerk, each times its θ, so that the linear muscle has w = [1 1 1 1 θ5 0 …]. Squares and cubes
/// model force, stiffness and heat transfer that depend on temperature; two plays of the position,
/// each with its rate, model hysteresis.
class MotionRegressors {
 public:
  enum : int {
    jerk,
    acceleration,
    velocity,
    position,
    constant,
    square,
    square_rate,
    cube,
    cube_rate,
    velocity_square,
    inertia_slope,
    narrow_play,
    narrow_play_rate,
    wide_play,
    wide_play_rate,
    count
  };
  using Values = Vector<double, count>;

  /// scale: of the muscle. max_W: > 0, the largest power.
  MotionRegressors(const RegressionScale& scale, double max_W)
      : dc_gain_m_per_W_(scale.dc_gain_m_per_W),
        moving_mass_kg_(scale.moving_mass_kg),
        per_max_W_(1.0 / max_W),
        plays_{Play(narrow_ratio * max_W), Play(wide_ratio * max_W)} {
    retune(scale.nominal);
  }

  /// Rescales the regressors to another muscle.
  void retune(const Theta& theta) {
    units_ = theta * dc_gain_m_per_W_;
    units_[0] *= moving_mass_kg_;
  }

  /// One tick. motion: in watts at rest (metres over the scale's DC gain), derivatives by seconds.
  void step(const ModelMotion<double>& motion, double model_jerk) {
    const double x = units_[3] * motion.position;
    const double v = units_[2] * motion.velocity;
    const double a = units_[1] * motion.acceleration;
    const double y = x * per_max_W_;
    for (Play& play : plays_)
      play.step(x);
    values_ << units_[0] * model_jerk, a, v, x, 1.0, x * y, v * y, x * y * y, v * y * y,
        v * v * per_max_W_, a * y, inside(plays_[0], x), rate(plays_[0], v), inside(plays_[1], x),
        rate(plays_[1], v);
  }
  const Values& values() const { return values_; }
  /// θ in watts at rest; θ1 is multiplied by the moving mass.
  const Theta& units() const { return units_; }

  /// The slope of power over velocity, relative to that of the linear muscle.
  double velocity_slope(const Values& weights) const {
    const double y = values_[position] * per_max_W_;
    return weights[velocity] + (weights[square_rate] + weights[cube_rate] * y) * y;
  }

 private:
  /// Fractions of the position that the largest power holds. Found by trials with hysteresis of 5
  /// and 15 %: 10 % and 30 % of the amplitude left twice the error.
  static constexpr double narrow_ratio = 0.01;
  static constexpr double wide_ratio = 0.15;

  static double inside(const Play& play, double x) { return x - play.output(); }
  static double rate(const Play& play, double v) { return play.engaged() ? v : 0.0; }

  double dc_gain_m_per_W_;
  double moving_mass_kg_;
  double per_max_W_;
  Theta units_;
  std::array<Play, 2> plays_;
  Values values_ = Values::Zero();
};

}  // namespace supercoil::control
