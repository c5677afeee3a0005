// The position controllers of an axis: one runs, and another takes over without a jump.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "loop/smoothed.hpp"

namespace supercoil {

/// All controllers of a muscle's configuration; the chosen one follows the reference.
class Tracking {
 public:
  /// At least one controller. Allocates; later calls do not.
  Tracking(const std::vector<control::ControllerSettings>& controllers,
           const control::PhysicalParameters& muscle, double step_s);

  std::size_t controllers() const { return controllers_.size(); }
  /// Place in the configuration.
  std::size_t chosen() const { return chosen_; }

  /// While not following: the power that acts.
  void set_power(double applied_W) { power_W_.set(applied_W); }
  /// Begins at this position. hold: begins with the power that is applied.
  void start(double position_m, double reference_m, bool hold,
             const control::PhysicalParameters& muscle);
  /// Changes the controller from the next start on.
  void choose(std::size_t place) { chosen_ = place; }
  /// Changes the controller at once: the new one continues where the running one leaves off.
  void take_over(std::size_t place, double reference_m, const control::PhysicalParameters& muscle);
  /// Swaps the controller at this place with another. following: if it is the running one, the new
  /// one continues at once, as in take_over().
  void exchange(std::size_t place, control::Controller& other, bool following, double reference_m,
                const control::PhysicalParameters& muscle);
  /// One tick of following.
  control::ControllerOutput step(const control::ControllerInput& input,
                                 const std::optional<control::Estimate>& estimate);
  /// The gain of the chosen controller that selector picks.
  control::GainValue gain(std::uint32_t selector) const {
    return controllers_[chosen_].gain(selector);
  }

 private:
  control::ControllerStart start_here(double reference_m) const;
  void start(std::size_t place, const control::ControllerStart& at,
             const control::PhysicalParameters& muscle);

  std::vector<control::Controller> controllers_;
  std::size_t chosen_ = 0;
  Smoothed power_W_;
  Smoothed error_m_;  ///< position minus that of the reference model
};

}  // namespace supercoil
