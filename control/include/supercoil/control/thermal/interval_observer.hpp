// How hot the muscle can be, given bounds on its thermal parameters.
#pragma once

#include <cmath>
#include <limits>

namespace supercoil::control {

/// Known bounds on the muscle's ψ and η, and on ψ/η.
template <class Real>
struct BasicThermalBounds {
  Real min_mass_J_per_K;
  Real max_mass_J_per_K;
  Real min_transfer_W_per_K;
  Real max_transfer_W_per_K;
  Real max_time_constant_s = std::numeric_limits<double>::infinity();
};
using ThermalBounds = BasicThermalBounds<double>;

/// The longest time constant that the bounds allow, in s.
inline double max_time_constant_s(const ThermalBounds& bounds) {
  return std::fmin(bounds.max_time_constant_s,
                   bounds.max_mass_J_per_K / bounds.min_transfer_W_per_K);
}

/// One end of an interval. Exact over the tick: the end approaches its rest value without passing
/// it, so the heat flow keeps its sign.
template <class Real>
struct BasicIntervalEnd {
  Real rest_K_per_W;
  Real heating_decay;
  Real cooling_decay;

  /// The rise one tick later, in K, with this power in between.
  Real next_K(Real rise_K, Real power_W) const {
    const Real rest_K = power_W * rest_K_per_W;
    return rest_K + (rise_K - rest_K) * (rest_K > rise_K ? heating_decay : cooling_decay);
  }
};

/// The factor by which a rise falls in step_s without power; all arguments > 0.
template <class Real>
Real thermal_decay(Real transfer_W_per_K, Real mass_J_per_K, Real step_s) {
  using std::exp;
  return exp(-transfer_W_per_K / mass_J_per_K * step_s);
}
/// For a muscle with at least this heat transfer, and a thermal mass within the bounds.
template <class Real>
BasicIntervalEnd<Real> hot_end(Real transfer_W_per_K, const BasicThermalBounds<Real>& bounds,
                               Real step_s) {
  return {1.0 / transfer_W_per_K, thermal_decay(transfer_W_per_K, bounds.min_mass_J_per_K, step_s),
          thermal_decay(transfer_W_per_K, bounds.max_mass_J_per_K, step_s)};
}
/// For a muscle with at most this heat transfer.
template <class Real>
BasicIntervalEnd<Real> cold_end(Real transfer_W_per_K, const BasicThermalBounds<Real>& bounds,
                                Real step_s) {
  return {1.0 / transfer_W_per_K, thermal_decay(transfer_W_per_K, bounds.max_mass_J_per_K, step_s),
          thermal_decay(transfer_W_per_K, bounds.min_mass_J_per_K, step_s)};
}

/// An interval observer of ψφ̇ = −ηφ + P (paper, Eq. (1)). φ̇ lies between the minimum and the
/// maximum of (P − ηφ)/ψ over the bounds, so by the comparison principle φ stays between the two
/// solutions, also when ψ and η change with time inside their bounds. Simply taking both lower
/// bounds is not enough: such an observer heats faster than the muscle but also cools faster, and
/// while cooling it reports too little.
///
/// A template so that tests/proof can run it on formulas instead of numbers and prove them.
template <class Real>
class BasicIntervalObserver {
 public:
  /// All bounds positive and in order; step_s > 0.
  BasicIntervalObserver(const BasicThermalBounds<Real>& bounds, Real step_s)
      : hot_(hot_end(bounds.min_transfer_W_per_K, bounds, step_s)),
        cold_(cold_end(bounds.max_transfer_W_per_K, bounds, step_s)) {}

  /// min_W, max_W ≥ 0: the power applied since the last tick lies between them.
  void step(Real min_W, Real max_W) {
    max_K_ = hot_.next_K(max_K_, max_W);
    min_K_ = cold_.next_K(min_K_, min_W);
  }
  /// The power is known exactly.
  void step(Real power_W) { step(power_W, power_W); }

  /// Temperature rise over ambient.
  Real min_K() const { return min_K_; }
  Real max_K() const { return max_K_; }

  /// For a start with unknown history: the rise may be anything from 0 to limit_K.
  void reset(Real limit_K) {
    min_K_ = 0.0;
    max_K_ = limit_K;
  }

 private:
  BasicIntervalEnd<Real> hot_;
  BasicIntervalEnd<Real> cold_;
  Real min_K_ = 0.0;
  Real max_K_ = 0.0;
};
using IntervalObserver = BasicIntervalObserver<double>;

}  // namespace supercoil::control
