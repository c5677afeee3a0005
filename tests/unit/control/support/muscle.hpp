// The muscle between ticks, exactly: the plant of closed loops in the tests.
#pragma once

#include "supercoil/control/actuator/state_space.hpp"
#include "supercoil/control/linear/discretize.hpp"
#include "supercoil/control/tracking/controller.hpp"

namespace supercoil::test {

class Muscle {
 public:
  Muscle(const control::PhysicalParameters& parameters, double step_s) : step_s_(step_s) {
    change(parameters);
  }
  /// Changes the muscle's parameters; temperature and length continue.
  void change(const control::PhysicalParameters& parameters) {
    const auto system = control::state_space(parameters);
    const auto discrete = control::zero_order_hold<3, 2>(system.a, system.b, step_s_);
    transition_ = discrete.transition;
    held_ = discrete.held;
  }
  /// The power is held over the step.
  void step(double power_W) {
    state_ = (transition_ * state_ + held_ * Eigen::Vector2d{power_W, 0.0}).eval();
  }
  double position_m() const { return state_[1]; }

 private:
  double step_s_;
  control::Matrix<double, 3> transition_;
  control::Matrix<double, 3, 2> held_;
  Eigen::Vector3d state_ = Eigen::Vector3d::Zero();
};

/// What a closed loop reports at a tick.
struct Tick {
  double time_s;
  double position_m;
  double model_m;
  double demanded_power_W;
  double applied_power_W;
};

/// Runs a controller on a muscle, the paper's if none is given. reference_m(time_s); observe(Tick)
/// at each tick.
template <class Controller, class Reference, class Observe>
void run_closed_loop(Controller& controller, double step_s, double duration_s,
                     const control::PowerRange& range, Reference reference_m, Observe observe,
                     const control::PhysicalParameters& parameters = {}) {
  Muscle muscle(parameters, step_s);
  double applied = 0.0;
  bool limited = false;
  const long ticks = std::lround(duration_s / step_s);
  for (long k = 0; k <= ticks; ++k) {
    const double time_s = static_cast<double>(k) * step_s;
    const double position = muscle.position_m();
    const auto out = controller.step({.reference_m = reference_m(time_s),
                                      .position_m = position,
                                      .applied_power_W = applied,
                                      .limited = limited});
    applied = range.clip(out.demanded_power_W);
    limited = applied != out.demanded_power_W;
    observe(Tick{time_s, position, out.model_m, out.demanded_power_W, applied});
    muscle.step(applied);
  }
}

/// 11 + 9 sin(0.25 t) mm: the sine of the paper's Sec. 5.2 at the physical scale.
inline double paper_sine_m(double time_s) {
  return 0.011 + 0.009 * std::sin(0.25 * time_s);
}

/// Eq. (18), in watts.
inline double paper_power_W(double time_s) {
  return std::sin(time_s) + std::sin(0.5 * time_s) + std::sin(0.25 * time_s) + 2.5;
}

inline constexpr control::PowerRange no_limits{-1e9, 1e9};

}  // namespace supercoil::test
