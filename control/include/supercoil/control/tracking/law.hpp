// The inputs and outputs of every tracking law at a tick, and the saturation of Eq. (19).
#pragma once

#include <concepts>
#include <cstddef>

#include "supercoil/control/tracking/gain.hpp"
#include "supercoil/control/tracking/reference_model.hpp"

namespace supercoil::control {

/// The factor by which a law lowers its feedback's gains each time its loop is found to oscillate.
inline constexpr double oscillation_gain_ratio = 0.7;
/// How often at most: to a seventeenth. A load or a fan that swings by itself looks like an
/// oscillation that no reduction ends, and must not turn the feedback off.
inline constexpr int max_oscillation_reductions = 8;

/// Inputs of one tick. Positions are in watts at rest (metres over the muscle's DC gain), so that
/// position, reference and power are of the same magnitude in every arithmetic.
template <class Scalar>
struct LawInput {
  Scalar reference{};         ///< r, this tick's
  Scalar position{};          ///< y, this tick's
  ModelMotion<Scalar> model;  ///< where the reference model is at this tick
  Scalar model_jerk{};        ///< its third derivative from this tick on
  Scalar applied{};           ///< the power really applied since the last tick
  bool limited = false;       ///< that power was not the demanded one
};

/// Where a law takes over from another, or starts: the state of the muscle in the law's units.
template <class Scalar>
struct LawStart {
  Scalar reference{};
  Scalar position{};
  ModelMotion<Scalar> model;
  Scalar power{};     ///< applied to the muscle now
  bool hold = false;  ///< the law's first power must be that one; otherwise the law's own
};

/// step() gives the demanded power in watts; gain(i) for i < gains are published. A law may also
/// have learn(Estimate), retune(Theta) and, for a loop that oscillates, slow_down().
template <class Law, class Scalar>
concept TrackingLaw = requires(Law law, const Law& running, const LawInput<Scalar>& input,
                               const LawStart<Scalar>& start, std::size_t i) {
  law.start(start);
  { law.step(input) } -> std::same_as<Scalar>;
  { Law::gains } -> std::convertible_to<std::size_t>;
  { running.gain(i) } -> std::same_as<GainValue>;
};

/// The saturation of Eq. (19), in watts.
struct PowerRange {
  double min_W = 0.0;
  double max_W = 4.5;

  /// The nearest power in the range.
  double clip(double power_W) const {
    if (!(power_W > min_W)) return min_W;  // NaN becomes the minimum power
    return power_W < max_W ? power_W : max_W;
  }
};

}  // namespace supercoil::control
