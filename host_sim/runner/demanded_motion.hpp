// The motion that a reference asks of a muscle, and how far a muscle without enough power falls
// behind it.
#pragma once

#include <cmath>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/reference_model.hpp"
#include "supercoil/control/tracking/reference_shaper.hpp"

#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// For a muscle that gets less power than its motion needs, or more: how much colder it is than it
/// should be, and how far behind.
class Lag {
 public:
  Lag(const control::PhysicalParameters& muscle, double step_s)
      : muscle_(muscle),
        step_s_(step_s),
        kept_ratio_(std::exp(muscle.thermal_pole_rad_per_s() * step_s)),
        K_per_W_((1.0 - kept_ratio_) / muscle.heat_transfer_W_per_K),
        moved_kg_(muscle.moving_mass_kg +
                  step_s * (muscle.damping_Ns_per_m + step_s * muscle.stiffness_N_per_m)) {}

  /// The power that makes up for the lag within a step.
  double catch_up_W() const { return kept_ratio_ * missing_K_ / K_per_W_; }
  /// power_W: what the muscle lacks of the power that its motion needs.
  void step(double power_W) {
    missing_K_ = kept_ratio_ * missing_K_ + K_per_W_ * power_W;
    // Implicit: stable at any step, even for a stiff muscle.
    const control::PhysicalParameters& m = muscle_;
    const double force_N =
        m.force_per_kelvin_N_per_K * missing_K_ - m.stiffness_N_per_m * behind_m_;
    speed_m_per_s_ = (m.moving_mass_kg * speed_m_per_s_ + step_s_ * force_N) / moved_kg_;
    behind_m_ += step_s_ * speed_m_per_s_;
  }
  double behind_m() const { return behind_m_; }
  /// The temperature difference, as the power that would hold it.
  double error_W() const { return muscle_.heat_transfer_W_per_K * std::abs(missing_K_); }
  /// Takes over the lag of a muscle with other parameters.
  void continue_from(const Lag& before) {
    missing_K_ = before.missing_K_;
    speed_m_per_s_ = before.speed_m_per_s_;
    behind_m_ = before.behind_m_;
  }

 private:
  control::PhysicalParameters muscle_;
  double step_s_;
  double kept_ratio_;  ///< of a difference in temperature, over a step
  double K_per_W_;     ///< after a step
  double moved_kg_;    ///< mass, and the equivalent of damping and stiffness over a step
  double missing_K_ = 0.0;
  double speed_m_per_s_ = 0.0;
  double behind_m_ = 0.0;
};

/// The motion that is asked for, and the one that shaping makes of it with the power available.
class DemandedMotion {
 public:
  DemandedMotion(const Conditions& c, double step_s)
      : inverse_(c.controller.model, {control::theta_from(c.muscle), {}, c.muscle.moving_mass_kg}),
        demanded_(c.controller.model, step_s),
        shaped_(demanded_),
        range_{c.power.min_W, c.power.max_W},
        shapes_(c.controller.shape_reference) {}

  /// It begins here, at rest.
  void start_at(double position_m) {
    demanded_.set({position_m, 0.0, 0.0});
    shaped_ = demanded_;
  }
  /// Continues a motion under other conditions.
  void continue_from(const DemandedMotion& before) {
    demanded_.set(before.demanded_.motion());
    shaped_.set(before.actual().motion());
  }

  /// Limits the power from now on.
  void set_max_W(double max_W) { range_.max_W = max_W; }
  /// The power that the muscle needs for it from now to the next step.
  double power_W(double reference_m) const {
    return inverse_.power_W(reference_m, actual().motion());
  }
  void step(double reference_m) {
    demanded_.step(reference_m);
    if (shapes_) shaped_.step(inverse_.step(reference_m, shaped_.motion(), range_).reference_m);
  }
  /// The part of the needed power that shaping leaves to the muscle.
  double feasible_W(double power_W) const { return shapes_ ? range_.clip(power_W) : power_W; }
  double demanded_m() const { return demanded_.motion().position; }
  double shaped_m() const { return actual().motion().position; }

 private:
  /// Without shaping both are one, and a step of one model is enough.
  const control::ReferenceModel<double>& actual() const { return shapes_ ? shaped_ : demanded_; }

  control::ReferenceShaper inverse_;
  control::ReferenceModel<double> demanded_;
  control::ReferenceModel<double> shaped_;  ///< not stepped without shaping
  control::PowerRange range_;
  bool shapes_;
};

}  // namespace supercoil::host_sim
