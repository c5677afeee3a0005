// Any controller in any arithmetic behind one call, in fixed storage.
#pragma once

#include <variant>

#include "supercoil/control/tracking/model_follower.hpp"

namespace supercoil::control {

/// A law of Laws, or open loop, with its reference model. Positions in metres, powers in watts, one
/// step() every step_s. It does not saturate its demand: the caller does (PowerRange) and says so
/// in ControllerInput.
class Controller {
 public:
  /// Settings must be valid (the configuration checks them), kind and arithmetic supported; step_s
  /// > 0 in seconds.
  Controller(const ControllerSettings& settings, double step_s);
  /// One tick: no heap, no exception, no operating system.
  ControllerOutput step(const ControllerInput& input);
  /// Call before the first step, and when it takes over: starts from `at` instead of from zero.
  void start(const ControllerStart& at);
  /// The muscle was identified, or is known from before: tunes the gains that depend on it. The
  /// same muscle again changes nothing that was learned since. theta: in its own units. Call before
  /// start(), not while it runs.
  void retune(const Theta& theta);
  /// What is known of the muscle, each tick before step(); used by laws with a model of it, and by
  /// every law for shaping its reference.
  void learn(const Estimate& estimate);
  /// The reference model's motion, in metres; zero in open loop.
  ModelMotion<double> motion() const;
  /// One of its gains. selector: its place among all gains, as a fraction in units of 2⁻³².
  GainValue gain(std::uint32_t selector) const;

 private:
  template <class Law, class Scalar>
  using Follower = ModelFollower<Scalar, typename Law::template In<Scalar>>;
  using Any = VariantOf<OpenLoopPower, Follower, Laws>::Type;

  static Any make(const ControllerSettings& settings, double step_s);

  Any any_;
};

}  // namespace supercoil::control
