#include "supercoil/control/tracking/sampled_loop.hpp"

#include "supercoil/control/actuator/state_space.hpp"
#include "supercoil/control/linear/discretize.hpp"
#include "supercoil/control/linear/filter.hpp"
#include "supercoil/control/linear/matrix_functions.hpp"

namespace supercoil::control {

namespace {

using DynamicMatrix = Eigen::MatrixXd;
using DynamicVector = Eigen::VectorXd;

/// The muscle's transition over part of a tick; the identity when that is zero.
ZeroOrderHold<3, 2> part_of_tick(const PhysicalParameters& muscle, double time_s) {
  const auto system = state_space(muscle);
  if (time_s > 0.0) return zero_order_hold<3, 2>(system.a, system.b, time_s);
  return {Matrix<double, 3>::Identity(), Matrix<double, 3, 2>::Zero()};
}

/// One tick of the closed loop. States: three of the muscle, two of the derivative filter, its last
/// input, the integral, two each of the filtered power and position, and the demanded powers, the
/// newest first.
class SampledLoop {
 public:
  SampledLoop(const FixedLaw& law, const PhysicalParameters& muscle, double step_s, double delay_s)
      : law_(law),
        step_s_(step_s),
        ticks_(static_cast<int>(delay_s / step_s)),
        before_(part_of_tick(muscle, delay_s - ticks_ * step_s)),
        after_(part_of_tick(muscle, step_s - (delay_s - ticks_ * step_s))),
        slope_(held_filter(squared_pole(law.derivative_filter_rad_per_s), step_s)) {
    if (!law.filtered) return;
    const Companion<2> filter(law.filtered->lambda);
    power_filter_ = zero_order_hold<2, 1>(filter.a, filter.b, step_s);
    position_filter_ = held_filter(law.filtered->lambda, step_s);
  }

  static constexpr int integral = 6;

  int size() const { return powers + ticks_ + 2; }

  DynamicVector step(const DynamicVector& x) const {
    DynamicVector next = DynamicVector::Zero(size());
    // The older power acts until the delay's fraction of a tick is over, then the next one.
    Vector<double, 3> muscle =
        before_.transition * x.head<3>() + before_.held.col(0) * x[powers + ticks_ + 1];
    muscle = (after_.transition * muscle + after_.held.col(0) * x[powers + ticks_]).eval();
    next.head<3>() = muscle;
    const double position = muscle[1];
    next.segment<2>(slope) = after(slope_, x.segment<2>(slope), x[last_position], position);
    next[last_position] = position;
    next[integral] = x[integral] - position * law_.integral_W_per_m_s * step_s_;
    const double pole = law_.derivative_filter_rad_per_s;
    next[powers] = next[integral] - position * law_.proportional_W_per_m -
                   next[slope + 1] * pole * pole * law_.derivative_Ws_per_m;
    if (law_.filtered) next[powers] += filtered(x, next);
    next.segment(powers + 1, ticks_ + 1) = x.segment(powers, ticks_ + 1);
    return next;
  }

 private:
  static FirstOrderHold<2, 1> held_filter(const Polynomial<2>& denominator, double step_s) {
    const Companion<2> filter(denominator);
    return first_order_hold<2, 1>(filter.a, filter.b, step_s);
  }
  static Vector<double, 2> after(const FirstOrderHold<2, 1>& filter, const Vector<double, 2>& state,
                                 double start, double end) {
    return filter.transition * state + filter.start * start + filter.end * end;
  }

  /// Steps the filters of power and position, and returns what the law adds through them. The power
  /// filter takes the power that acted in this tick.
  double filtered(const DynamicVector& x, DynamicVector& next) const {
    const FilteredFeedback& law = *law_.filtered;
    const double position = next[1];
    const Vector<double, 2> u = power_filter_.transition * x.segment<2>(filtered_power) +
                                power_filter_.held * x[powers + ticks_];
    const Vector<double, 2> y =
        after(position_filter_, x.segment<2>(filtered_position), x[last_position], position);
    next.segment<2>(filtered_power) = u;
    next.segment<2>(filtered_position) = y;
    return law.on_power[0] * u[0] + law.on_power[1] * u[1] + law.on_position_W_per_m[0] * y[0] +
           law.on_position_W_per_m[1] * y[1] + law.direct_W_per_m * position;
  }

  static constexpr int slope = 3;
  static constexpr int last_position = 5;
  static constexpr int filtered_power = 7;
  static constexpr int filtered_position = 9;
  static constexpr int powers = 11;

  FixedLaw law_;
  double step_s_;
  int ticks_;  ///< whole ticks of the delay
  ZeroOrderHold<3, 2> before_;
  ZeroOrderHold<3, 2> after_;
  FirstOrderHold<2, 1> slope_;
  ZeroOrderHold<2, 1> power_filter_{};
  FirstOrderHold<2, 1> position_filter_{};
};

/// Scales states by powers of two until each row's norm is near its column's, which changes no
/// eigenvalue (Parlett and Reinsch 1969). Otherwise positions in metres beside powers in watts cost
/// five digits.
void balance(DynamicMatrix& a) {
  constexpr int max_rounds = 100;
  bool goes_on = true;
  for (int round = 0; goes_on && round < max_rounds; ++round) {
    goes_on = false;
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      const double diagonal = std::abs(a(i, i));
      const double column = a.col(i).cwiseAbs().sum() - diagonal;
      const double row = a.row(i).cwiseAbs().sum() - diagonal;
      if (column == 0.0 || row == 0.0) continue;
      const double factor = std::exp2(std::nearbyint(0.5 * std::log2(row / column)));
      if (factor == 1.0) continue;
      a.col(i) *= factor;
      a.row(i) /= factor;
      goes_on = true;
    }
  }
}

struct Sampling {
  double step_s;
  double delay_s;
};

/// Uses longer ticks for a delay of many: each tick of delay is a state, and eigenvalues cost the
/// cube of their number. The sum of delay and hold stays the same.
Sampling affordable(double step_s, double delay_s) {
  constexpr int max_ticks = 16;
  if (delay_s <= max_ticks * step_s) return {step_s, delay_s};
  const double longer_s = (delay_s + 0.5 * step_s) / (max_ticks + 0.5);
  return {longer_s, max_ticks * longer_s};
}

}  // namespace

/// Without an integral term the integral's state is constant: a pole at 1 that is not the loop's,
/// so it is removed.
double spectral_radius(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                       double delay_s) {
  const Sampling sampling = affordable(step_s, delay_s);
  const SampledLoop loop(law, muscle, sampling.step_s, sampling.delay_s);
  const int size = loop.size();
  DynamicMatrix transition(size, size);
  for (int i = 0; i < size; ++i)
    transition.col(i) = loop.step(DynamicVector::Unit(size, i));
  if (law.integral_W_per_m_s == 0.0) {
    transition.row(SampledLoop::integral).setZero();
    transition.col(SampledLoop::integral).setZero();
  }
  balance(transition);
  const double radius = eigenvalues(transition).cwiseAbs().maxCoeff();
  return std::pow(radius, step_s / sampling.step_s);
}

}  // namespace supercoil::control
