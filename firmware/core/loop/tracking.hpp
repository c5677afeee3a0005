// The controllers of a position: one is at work, and the next takes over without a jump.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "loop/smoothed.hpp"

namespace supercoil {

class Tracking {
 public:
  /// At least one controller. Allocates; nothing after it does.
  Tracking(const std::vector<control::ControllerSettings>& controllers,
           const control::PhysicalParameters& muscle, double step_s);

  std::size_t controllers() const { return controllers_.size(); }
  /// Place in the configuration.
  std::size_t chosen() const { return chosen_; }

  /// Not following: this power acts.
  void set_power(double applied_W) { power_W_.set(applied_W); }
  /// Begins at this position. hold: the power goes on from the one that acts.
  void start(double position_m, double reference_m, bool hold,
             const control::PhysicalParameters& muscle);
  /// Another controller, from the next start on.
  void choose(std::size_t place) { chosen_ = place; }
  /// Another controller, at once: it goes on where the one that is at work leaves off.
  void take_over(std::size_t place, double reference_m, const control::PhysicalParameters& muscle);
  /// The one at this place is exchanged for another. following: at once where it is at work, as
  /// take_over does.
  void exchange(std::size_t place, control::Controller& other, bool following, double reference_m,
                const control::PhysicalParameters& muscle);
  /// One tick of following.
  control::ControllerOutput step(const control::ControllerInput& input,
                                 const std::optional<control::Estimate>& estimate);
  /// One gain of the controller that is chosen, in turn.
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
  Smoothed error_m_;  ///< position over the reference model
};

}  // namespace supercoil
