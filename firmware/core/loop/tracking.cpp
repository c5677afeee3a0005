#include "loop/tracking.hpp"

#include <utility>

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil {

namespace {

/// Long compared with the sensor's noise, short compared with the muscle's motion.
constexpr double smoothing_s = 0.2;

}  // namespace

Tracking::Tracking(const std::vector<control::ControllerSettings>& controllers,
                   const control::PhysicalParameters& muscle, double step_s)
    : power_W_(smoothing_s, step_s), error_m_(smoothing_s, step_s) {
  for (const auto& controller : controllers)
    controllers_.emplace_back(controller, step_s).retune(control::theta_from(muscle));
}

void Tracking::start(double position_m, double reference_m, bool hold,
                     const control::PhysicalParameters& muscle) {
  error_m_.set(0.0);
  control::ControllerStart at = start_here(reference_m);
  at.motion = {position_m, 0.0, 0.0};
  at.position_m = position_m;
  at.hold = hold;
  start(chosen_, at, muscle);
}

void Tracking::take_over(std::size_t place, double reference_m,
                         const control::PhysicalParameters& muscle) {
  control::ControllerStart at = start_here(reference_m);
  at.hold = true;
  start(place, at, muscle);
  chosen_ = place;
}

void Tracking::exchange(std::size_t place, control::Controller& other, bool following,
                        double reference_m, const control::PhysicalParameters& muscle) {
  control::ControllerStart at = start_here(reference_m);
  at.hold = true;
  std::swap(controllers_[place], other);
  if (following && place == chosen_) {
    start(place, at, muscle);
  } else {
    controllers_[place].retune(control::theta_from(muscle));
  }
}

control::ControllerOutput Tracking::step(const control::ControllerInput& input,
                                         const std::optional<control::Estimate>& estimate) {
  control::Controller& controller = controllers_[chosen_];
  if (estimate) controller.learn(*estimate);
  const control::ControllerOutput output = controller.step(input);
  // In this order: g++ loads error_m_ with the member before it, and would wait for power_W_.
  error_m_.step(input.position_m - output.model_m);
  power_W_.step(input.applied_power_W);
  return output;
}

/// Where the running controller leaves off. Power and error are smoothed alike: in a single tick
/// they contain the sensor's noise times the controller's gain.
control::ControllerStart Tracking::start_here(double reference_m) const {
  control::ControllerStart at;
  at.reference_m = reference_m;
  at.motion = controllers_[chosen_].motion();
  at.position_m = at.motion.position + error_m_.value();
  at.power_W = power_W_.value();
  return at;
}

/// With gains for the muscle as now known: a running controller would jump at new gains.
void Tracking::start(std::size_t place, const control::ControllerStart& at,
                     const control::PhysicalParameters& muscle) {
  controllers_[place].retune(control::theta_from(muscle));
  controllers_[place].start(at);
}

}  // namespace supercoil
