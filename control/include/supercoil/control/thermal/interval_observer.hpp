// How hot the muscle can be, given what is known of it.
#pragma once

#include <cmath>

namespace supercoil::control {

/// Bounds that are known to hold of the muscle's ψ and η.
template <class Real>
struct BasicThermalBounds {
  Real lowest_mass_J_per_K;
  Real highest_mass_J_per_K;
  Real lowest_transfer_W_per_K;
  Real highest_transfer_W_per_K;
};
using ThermalBounds = BasicThermalBounds<double>;

/// One end of an interval. Exact over the tick: it comes nearer to its rest value and never passes
/// it, so the heat flow keeps its sign.
template <class Real>
struct BasicIntervalEnd {
  Real rest_K_per_W;
  Real heating_decay;
  Real cooling_decay;

  Real moved(Real rise_K, Real power_W) const {
    const Real rest_K = power_W * rest_K_per_W;
    return rest_K + (rise_K - rest_K) * (rest_K > rise_K ? heating_decay : cooling_decay);
  }
};

template <class Real>
Real thermal_decay(Real transfer_W_per_K, Real mass_J_per_K, Real step_s) {
  using std::exp;
  return exp(-transfer_W_per_K / mass_J_per_K * step_s);
}
/// Of a muscle with at least this heat transfer, and a mass within the bounds.
template <class Real>
BasicIntervalEnd<Real> hot_end(Real transfer_W_per_K, const BasicThermalBounds<Real>& bounds,
                               Real step_s) {
  return {1.0 / transfer_W_per_K,
          thermal_decay(transfer_W_per_K, bounds.lowest_mass_J_per_K, step_s),
          thermal_decay(transfer_W_per_K, bounds.highest_mass_J_per_K, step_s)};
}
/// Of one with at most this heat transfer.
template <class Real>
BasicIntervalEnd<Real> cold_end(Real transfer_W_per_K, const BasicThermalBounds<Real>& bounds,
                                Real step_s) {
  return {1.0 / transfer_W_per_K,
          thermal_decay(transfer_W_per_K, bounds.highest_mass_J_per_K, step_s),
          thermal_decay(transfer_W_per_K, bounds.lowest_mass_J_per_K, step_s)};
}

/// An interval observer of ψφ̇ = −ηφ + P (paper, Eq. (1)). φ̇ lies between the least and the greatest
/// of (P − ηφ)/ψ over the bounds, so by the comparison principle φ stays between the two solutions,
/// also when ψ and η change with time inside their bounds. Simply taking both lower bounds is not
/// enough: such an observer heats faster than the muscle and then cools faster as well, and while
/// cooling it reports too little.
///
/// A template so that tests/proof can run it on formulas instead of numbers and prove them.
template <class Real>
class BasicIntervalObserver {
 public:
  /// All bounds positive and in order; step_s > 0.
  BasicIntervalObserver(const BasicThermalBounds<Real>& bounds, Real step_s)
      : hot_(hot_end(bounds.lowest_transfer_W_per_K, bounds, step_s)),
        cold_(cold_end(bounds.highest_transfer_W_per_K, bounds, step_s)) {}

  /// least_W, most_W ≥ 0: what was applied since the last tick lies between them.
  void step(Real least_W, Real most_W) {
    highest_K_ = hot_.moved(highest_K_, most_W);
    lowest_K_ = cold_.moved(lowest_K_, least_W);
  }
  void step(Real power_W) { step(power_W, power_W); }

  /// Temperature rise over ambient.
  Real lowest_K() const { return lowest_K_; }
  Real highest_K() const { return highest_K_; }

  /// After a start whose history is unknown: anything from 0 to at_most_K.
  void reset(Real at_most_K) {
    lowest_K_ = 0.0;
    highest_K_ = at_most_K;
  }

 private:
  BasicIntervalEnd<Real> hot_;
  BasicIntervalEnd<Real> cold_;
  Real lowest_K_ = 0.0;
  Real highest_K_ = 0.0;
};
using IntervalObserver = BasicIntervalObserver<double>;

}  // namespace supercoil::control
