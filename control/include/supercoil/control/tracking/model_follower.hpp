// A law behind its reference model, in SI units, as every controller runs it.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "supercoil/control/estimation/estimate.hpp"
#include "supercoil/control/tracking/controller_settings.hpp"
#include "supercoil/control/tracking/oscillation_detector.hpp"
#include "supercoil/control/tracking/reference_shaper.hpp"

namespace supercoil::control {

/// One tick's inputs in SI units.
struct ControllerInput {
  double reference_m = 0.0;
  double reference_power_W = 0.0;  ///< for open loop
  double position_m = 0.0;
  double applied_power_W = 0.0;  ///< really applied since the last tick
  bool limited = false;          ///< that power was not the demanded one
  PowerRange range{};            ///< allowed for the muscle, for shaping
  /// Leads the model along a trajectory, by the reference under which it moves that way.
  /// reference_m is then ignored.
  std::optional<TrajectoryPoint> trajectory{};
};

/// A controller's output at a tick. The power is not yet saturated.
struct ControllerOutput {
  double demanded_power_W = 0.0;
  double model_m = 0.0;  ///< where the reference model is: what tracking is measured against
  Infeasible infeasible = Infeasible::nothing;  ///< why the reference was shaped
  /// Of an oscillation of the loop itself with the present muscle; the feedback has then been
  /// slowed down if allowed. 0: it has not oscillated.
  double oscillation_period_s = 0.0;
};

/// Where a controller starts, or takes over from another while the muscle is hot.
struct ControllerStart {
  double reference_m = 0.0;
  double position_m = 0.0;
  double power_W = 0.0;          ///< applied to the muscle now
  ModelMotion<double> motion{};  ///< of the reference model so far, in metres
  bool hold = false;             ///< the first demanded power is that power
};

/// Open loop: the reference is a power.
class OpenLoopPower {
 public:
  /// Nothing to start: it has no state.
  void start(const ControllerStart&) {}
  /// Nothing to learn: it has no model of the muscle.
  void learn(const Estimate&) {}
  /// Nothing depends on the muscle.
  void retune(const Theta&) {}
  /// Demands reference_power_W.
  ControllerOutput step(const ControllerInput& in) const {
    return {.demanded_power_W = in.reference_power_W};
  }
  ModelMotion<double> motion() const { return {}; }
  /// It has no gains.
  static GainValue gain(std::uint32_t) { return {}; }
};

/// A law with its reference model; converts between SI and the law's scalar.
template <class Scalar, TrackingLaw<Scalar> Law>
class ModelFollower {
 public:
  ModelFollower(const ControllerSettings& s, Law law, double step_s)
      : model_settings_(s.model),
        model_(s.model, step_s),
        law_(std::move(law)),
        oscillation_(step_s),
        slow_when_oscillating_(s.slow_when_oscillating),
        to_watts_(1.0 / s.dc_gain_m_per_W),
        to_metres_(s.dc_gain_m_per_W),
        fading_(std::exp(-step_s / bridge_s)) {}

  /// See Controller, here and below.
  void start(const ControllerStart& at) {
    model_.set({to<Scalar>(at.motion.position * to_watts_),
                to<Scalar>(at.motion.velocity * to_watts_),
                to<Scalar>(at.motion.acceleration * to_watts_)});
    last_reference_ = to<Scalar>(at.reference_m * to_watts_);
    law_.start({last_reference_, to<Scalar>(at.position_m * to_watts_), model_.motion(),
                to<Scalar>(at.power_W), at.hold});
    oscillation_.restart();
    bridge_W_ = 0.0;
    bridging_ = at.hold;
    held_W_ = at.power_W;
  }

  /// One tick. No heap and no exception.
  ControllerOutput step(const ControllerInput& in) {
    model_.step(last_reference_);
    const double reference_m =
        in.trajectory ? model_settings_.reference_for(*in.trajectory, motion()) : in.reference_m;
    const FeasibleReference feasible =
        shaper_ ? shaper_->step(reference_m, motion(), in.range) : FeasibleReference{reference_m};
    LawInput<Scalar> input;
    input.reference = to<Scalar>(feasible.reference_m * to_watts_);
    input.position = to<Scalar>(in.position_m * to_watts_);
    input.model = model_.motion();
    input.model_jerk = model_.jerk(input.reference);
    input.applied = to<Scalar>(in.applied_power_W);
    input.limited = in.limited;
    last_reference_ = input.reference;
    watch(in.position_m, static_cast<double>(input.model.position) * to_metres_);
    const auto demanded = static_cast<double>(law_.step(input));
    if (bridging_) {
      // The part that the law itself could not take over is added, and fades.
      bridge_W_ = held_W_ - demanded;
      bridging_ = false;
    }
    const double bridged_W = demanded + bridge_W_;
    bridge_W_ *= fading_;
    return {bridged_W, static_cast<double>(input.model.position) * to_metres_, feasible.infeasible,
            oscillation_period_s_};
  }

  /// From now on references are made feasible first.
  void shape_by(const ReferenceShaper& shaper) { shaper_ = shaper; }
  /// Passes θ on to a law whose gains depend on the muscle; forgets a detected oscillation.
  void retune(const Theta& theta) {
    if (tuned_for_ == theta) return;
    tuned_for_ = theta;
    oscillation_period_s_ = 0.0;
    reductions_ = 0;
    if (shaper_) shaper_->retune(theta);
    if constexpr (requires { law_.retune(theta); }) law_.retune(theta);
  }

  /// Passes the estimate on to the shaper and to a law that has a model of the muscle.
  void learn(const Estimate& estimate) {
    if (shaper_) shaper_->learn(estimate);
    if constexpr (requires { law_.learn(estimate); }) law_.learn(estimate);
  }

  ModelMotion<double> motion() const {
    const ModelMotion<Scalar> m = model_.motion();
    return {static_cast<double>(m.position) * to_metres_,
            static_cast<double>(m.velocity) * to_metres_,
            static_cast<double>(m.acceleration) * to_metres_};
  }

  /// All gains come round as selector takes all values, whatever its step (see Controller).
  GainValue gain(std::uint32_t selector) const {
    return law_.gain((std::uint64_t{selector} * Law::gains) >> 32U);
  }

  const Law& law() const { return law_; }

 private:
  void watch(double position_m, double model_m) {
    if (!oscillation_.step(model_m - position_m, model_m)) return;
    oscillation_period_s_ = oscillation_.period_s();
    if constexpr (requires { law_.slow_down(); }) {
      if (!slow_when_oscillating_ || reductions_ == max_oscillation_reductions) return;
      ++reductions_;
      law_.slow_down();
    }
  }

  ReferenceModelSettings model_settings_;
  ReferenceModel<Scalar> model_;
  Law law_;
  OscillationDetector oscillation_;
  bool slow_when_oscillating_;
  double oscillation_period_s_ = 0.0;
  int reductions_ = 0;  // of the feedback, because of oscillations
  std::optional<ReferenceShaper> shaper_;
  std::optional<Theta> tuned_for_;
  /// Slower than every law here: the loop, not the fading, decides where the muscle is.
  static constexpr double bridge_s = 10.0;

  Scalar last_reference_{};
  double to_watts_;
  double to_metres_;
  double fading_;
  double held_W_ = 0.0;
  double bridge_W_ = 0.0;
  bool bridging_ = false;
};

}  // namespace supercoil::control
