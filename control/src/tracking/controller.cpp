#include "supercoil/control/tracking/controller.hpp"

namespace supercoil::control {

Controller::Any Controller::make(const ControllerSettings& s, double step_s) {
  Any made;
  with_running<Laws>(s, [&](auto law, auto scalar, const auto& own) {
    using Law = decltype(law);
    using Scalar = decltype(scalar);
    const LawContext context{s.model, s.dc_gain_m_per_W};
    made.emplace<Follower<Law, Scalar>>(s, Law::template make<Scalar>(own, context, step_s),
                                        step_s);
  });
  return made;
}

Controller::Controller(const ControllerSettings& settings, double step_s)
    : any_(make(settings, step_s)) {
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
