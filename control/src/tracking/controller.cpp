#include "supercoil/control/tracking/controller.hpp"

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::control {

void ControllerSettings::set_nominal(const PhysicalParameters& muscle, double max_W) {
  dc_gain_m_per_W = muscle.dc_gain_m_per_W();
  const RegressionScale scale{theta_from(muscle), dc_gain_m_per_W, muscle.moving_mass_kg};
  shaped_for = adaptive_ff.scale = learned_ff.scale = mrac_ls.scale = scale;
  pd_ff.feedforward_W_per_m = 1.0 / dc_gain_m_per_W;
  if (std::isfinite(max_W)) learned_ff.max_W = max_W;
}

template <class Scalar>
Controller::Any Controller::make(const ControllerSettings& s, double step_s) {
  const double gain = s.dc_gain_m_per_W;
  switch (s.kind) {
    case ControllerKind::pi:
      return PiFollower<Scalar>(s, Pi<Scalar>(s.pi, gain, step_s), step_s);
    case ControllerKind::pd_ff:
      return PdFollower<Scalar>(s, PdFeedforward<Scalar>(s.pd_ff, gain, step_s), step_s);
    case ControllerKind::mrac:
      return MracFollower<Scalar>(s, Mrac<Scalar>(s.mrac, step_s), step_s);
    case ControllerKind::mrac_ls:
      if constexpr (std::is_floating_point_v<Scalar>) {
        return MracLeastSquaresFollower<Scalar>(
            s, MracLeastSquares<Scalar>(s.mrac_ls, s.model, step_s), step_s);
      } else {
        break;
      }
    case ControllerKind::adaptive_ff:
      return AdaptiveFollower<Scalar>(s, AdaptiveFeedforward<Scalar>(s.adaptive_ff, step_s),
                                      step_s);
    case ControllerKind::learned_ff:
      if constexpr (std::is_floating_point_v<Scalar>) {
        return LearnedFollower<Scalar>(s, LearnedFeedforward<Scalar>(s.learned_ff, step_s), step_s);
      } else {
        break;
      }
    case ControllerKind::power:
      break;
  }
  return OpenLoopPower{};
}

Controller::Any Controller::choose(const ControllerSettings& settings, double step_s) {
  switch (settings.arithmetic) {
    case Arithmetic::float32:
      return make<float>(settings, step_s);
    case Arithmetic::q8_24:
      return make<Q8_24>(settings, step_s);
    case Arithmetic::float64:
      break;
  }
  return make<double>(settings, step_s);
}

Controller::Controller(const ControllerSettings& settings, double step_s)
    : any_(choose(settings, step_s)) {
  if (!settings.shape_reference) return;
  const ReferenceShaper shaper(settings.model, settings.shaped_for);
  const auto shape = [&](auto& controller) {
    if constexpr (requires { controller.shape_by(shaper); }) controller.shape_by(shaper);
  };
  std::visit(shape, any_);
}

ControllerOutput Controller::step(const ControllerInput& input) {
  return std::visit([&](auto& controller) { return controller.step(input); }, any_);
}

void Controller::start(const ControllerStart& at) {
  std::visit([&](auto& controller) { controller.start(at); }, any_);
}

void Controller::retune(const Theta& theta) {
  std::visit([&](auto& controller) { controller.retune(theta); }, any_);
}

void Controller::learn(const Estimate& estimate) {
  std::visit([&](auto& controller) { controller.learn(estimate); }, any_);
}

ModelMotion<double> Controller::motion() const {
  return std::visit([](const auto& controller) { return controller.motion(); }, any_);
}

GainValue Controller::gain(std::uint32_t selector) const {
  return std::visit([&](const auto& controller) { return controller.gain(selector); }, any_);
}

}  // namespace supercoil::control
