#include "supercoil/control/tracking/controller.hpp"

namespace supercoil::control {

template <class Scalar>
Controller::Any Controller::make(const ControllerSettings& s, double step_s) {
  Any made;
  with_chosen<Laws>(s, [&](auto law, const auto& own) {
    using Law = decltype(law);
    if constexpr (Law::fixed_point || std::is_floating_point_v<Scalar>) {
      const LawContext context{s.model, s.dc_gain_m_per_W};
      made.emplace<Follower<Law, Scalar>>(s, Law::template make<Scalar>(own, context, step_s),
                                          step_s);
    }
  });
  return made;
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
