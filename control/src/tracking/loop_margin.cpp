#include "supercoil/control/tracking/loop_margin.hpp"

#include <complex>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/actuator/state_space.hpp"
#include "supercoil/control/linear/discretize.hpp"

namespace supercoil::control {

namespace {

using DynamicMatrix = Eigen::MatrixXd;
using DynamicVector = Eigen::VectorXd;

/// What the muscle becomes within a part of a tick; nothing in no time.
ZeroOrderHold<3, 2> part_of_tick(const PhysicalParameters& muscle, double time_s) {
  const auto system = state_space(muscle);
  if (time_s > 0.0) return zero_order_hold<3, 2>(system.a, system.b, time_s);
  return {Matrix<double, 3>::Identity(), Matrix<double, 3, 2>::Zero()};
}

/// One tick of the closed loop. States: three of the muscle, two of the derivative filter, its last
/// input, the integral, and the powers that were asked for, the newest first.
class SampledLoop {
 public:
  SampledLoop(const FixedLaw& law, const PhysicalParameters& muscle, double step_s, double delay_s)
      : law_(law),
        step_s_(step_s),
        ticks_(static_cast<int>(delay_s / step_s)),
        before_(part_of_tick(muscle, delay_s - ticks_ * step_s)),
        after_(part_of_tick(muscle, step_s - (delay_s - ticks_ * step_s))),
        filter_(held_filter(law.derivative_filter_rad_per_s, step_s)) {}

  int size() const { return powers + ticks_ + 2; }

  DynamicVector step(const DynamicVector& x) const {
    DynamicVector next = DynamicVector::Zero(size());
    // Until the delay of the newest power but `ticks` is over, the one before it acts.
    Vector<double, 3> muscle =
        before_.transition * x.head<3>() + before_.held.col(0) * x[powers + ticks_ + 1];
    muscle = (after_.transition * muscle + after_.held.col(0) * x[powers + ticks_]).eval();
    next.head<3>() = muscle;
    const double position = muscle[1];
    next.segment<2>(slope) = filter_.transition * x.segment<2>(slope) +
                             filter_.start * x[last_position] + filter_.end * position;
    next[last_position] = position;
    next[integral] = x[integral] - position * law_.integral_W_per_m_s * step_s_;
    const double pole = law_.derivative_filter_rad_per_s;
    next[powers] = next[integral] - position * law_.proportional_W_per_m -
                   next[slope + 1] * pole * pole * law_.derivative_Ws_per_m;
    next.segment(powers + 1, ticks_ + 1) = x.segment(powers, ticks_ + 1);
    return next;
  }

 private:
  static FirstOrderHold<2, 1> held_filter(double pole, double step_s) {
    const Companion<2> filter({pole * pole, 2.0 * pole, 1.0});
    return first_order_hold<2, 1>(filter.a, filter.b, step_s);
  }

  static constexpr int slope = 3;
  static constexpr int last_position = 5;
  static constexpr int integral = 6;
  static constexpr int powers = 7;

  FixedLaw law_;
  double step_s_;
  int ticks_;  ///< whole ones, of the delay
  ZeroOrderHold<3, 2> before_;
  ZeroOrderHold<3, 2> after_;
  FirstOrderHold<2, 1> filter_;
};

/// Scales states by powers of two until each row's norm is near its column's, which changes no
/// eigenvalue: positions in metres beside powers in watts cost five digits of them (Parlett and
/// Reinsch 1969).
void balance(DynamicMatrix& a) {
  constexpr int most_rounds = 100;
  bool goes_on = true;
  for (int round = 0; goes_on && round < most_rounds; ++round) {
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

/// Without an integral its state stays where it is, whatever the rest does: a pole at 1 that is
/// nobody's.
double spectral_radius(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                       double delay_s) {
  const SampledLoop loop(law, muscle, step_s, delay_s);
  const int size = loop.size();
  DynamicMatrix transition(size, size);
  for (int i = 0; i < size; ++i)
    transition.col(i) = loop.step(DynamicVector::Unit(size, i));
  if (law.integral_W_per_m_s == 0.0) {
    transition.row(6).setZero();
    transition.col(6).setZero();
  }
  balance(transition);
  return transition.eigenvalues().cwiseAbs().maxCoeff();
}

/// In continuous time, with half a tick for the hold.
double modulus(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
               double delay_s) {
  using namespace std::complex_literals;
  constexpr double lowest_rad_per_s = 0.01;
  constexpr double finer = 1.01;
  const Theta theta = theta_from(muscle);
  const double span = std::log(std::numbers::pi / step_s / lowest_rad_per_s);
  const auto points = static_cast<int>(span / std::log(finer));
  double least = 1.0;
  for (int i = 0; i <= points; ++i) {
    const std::complex<double> p = 1i * lowest_rad_per_s * std::pow(finer, i);
    const auto lag = p / law.derivative_filter_rad_per_s + 1.0;
    const auto acts = law.proportional_W_per_m + law.integral_W_per_m_s / p +
                      law.derivative_Ws_per_m * p / (lag * lag);
    const auto needs =
        ((theta[0] * muscle.moving_mass_kg * p + theta[1]) * p + theta[2]) * p + theta[3];
    least =
        std::fmin(least, std::abs(1.0 + acts / needs * std::exp(-p * (delay_s + 0.5 * step_s))));
  }
  return least;
}

PhysicalParameters corner_of(const PhysicalParameters& nominal, double span, int corner) {
  PhysicalParameters muscle = nominal;
  for (std::size_t i = 0; i < physical_ranges.size(); ++i)
    muscle.*physical_ranges[i].member *= ((corner >> i) & 1) != 0 ? 1.0 + span : 1.0 - span;
  return muscle;
}

constexpr int corners = 1 << physical_ranges.size();

}  // namespace

std::optional<FixedLaw> fixed_law(const ControllerSettings& s, const PhysicalParameters& muscle) {
  switch (s.kind) {
    case ControllerKind::pi:
      return FixedLaw{s.pi.proportional_W_per_m, s.pi.integral_W_per_m_s};
    case ControllerKind::pd_ff:
      return FixedLaw{s.pd_ff.proportional_W_per_m, 0.0, s.pd_ff.derivative_Ws_per_m,
                      s.pd_ff.derivative_filter_rad_per_s};
    case ControllerKind::adaptive_ff: {
      const Theta gains = theta_from(muscle) * s.adaptive_ff.bandwidth_rad_per_s;
      return FixedLaw{gains[2], gains[3], gains[1], s.adaptive_ff.derivative_filter_rad_per_s};
    }
    case ControllerKind::power:
    case ControllerKind::mrac:
    case ControllerKind::mrac_ls:
      break;
  }
  return std::nullopt;
}

LoopMargin loop_margin(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                       double delay_s) {
  return {spectral_radius(law, muscle, step_s, delay_s), modulus(law, muscle, step_s, delay_s)};
}

WorstCorner worst_corner(const FixedLaw& law, const PhysicalParameters& nominal, double span,
                         double step_s, double delay_s) {
  WorstCorner worst;
  for (int corner = 0; corner < corners; ++corner) {
    const PhysicalParameters muscle = corner_of(nominal, span, corner);
    const LoopMargin margin = loop_margin(law, muscle, step_s, delay_s);
    worst.unstable += static_cast<int>(!margin.stable());
    const bool first = corner == 0;
    const bool worse = margin.stable() && worst.margin.stable()
                           ? margin.modulus < worst.margin.modulus
                           : margin.spectral_radius > worst.margin.spectral_radius;
    if (first || worse) {
      worst.margin = margin;
      worst.muscle = muscle;
    }
  }
  return worst;
}

double tolerated_span(const FixedLaw& law, const PhysicalParameters& nominal, double step_s,
                      double delay_s) {
  double stable = 0.0;
  double unstable = 0.9;
  while (unstable - stable > 0.01) {
    const double span = 0.5 * (stable + unstable);
    bool holds = true;
    for (int corner = 0; holds && corner < corners; ++corner)
      holds = spectral_radius(law, corner_of(nominal, span, corner), step_s, delay_s) < 1.0;
    (holds ? stable : unstable) = span;
  }
  return stable;
}

}  // namespace supercoil::control
