// A joint that two muscles turn, or one against a spring or a weight.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "supercoil/control/joint/lever.hpp"

#include "plant/guide_friction.hpp"
#include "plant/mechanics.hpp"
#include "plant/muscle_body.hpp"
#include "plant/nonlinear_plant.hpp"

namespace supercoil::host_sim {

/// The moving mass in its parameters is ignored: the joint has an inertia.
struct JointMuscle {
  control::PhysicalParameters parameters;
  PlantEffects effects;
  bool torn = false;     ///< it no longer pulls
  double slack_m = 0.0;  ///< of its cable: contraction that is lost before it pulls
};

/// The angle is zero where the new, cold agonist pulls with pretension_N and the antagonist with an
/// equal moment. The agonist turns the joint towards positive angles.
struct JointPlantSettings {
  JointMuscle agonist;
  std::optional<JointMuscle> antagonist;  ///< absent: only spring and weight oppose
  control::Lever lever;                   ///< of the agonist
  double antagonist_lever_ratio = 1.0;    ///< antagonist's lever over the agonist's, at every angle
  double inertia_kg_m2 = 2e-5;
  double damping_Nms_per_rad = 0.0;  ///< in addition to the muscles'
  double spring_Nm_per_rad = 0.0;    ///< towards angle 0, in addition to the muscles
  double pretension_N = 0.883;       ///< of the agonist
  bool spring_pretensions = true;    ///< without an antagonist, the spring holds it
  double friction_ratio = 0.0;       ///< Coulomb friction at the lever over the pretension
  double weight_Nm = 0.0;            ///< moment of the level arm
  double hangs_at_rad = 0.0;         ///< angle at which the arm hangs freely
  double min_angle_rad = -1.5;       ///< end stops
  double max_angle_rad = 1.5;
  int substeps = 4;  ///< of the mechanics, in each thermal step
};

/// (I/r²) ẍ = ρ (T₁ − q T₂) − c ẋ − k x − (w sin(α − α₀) + load)/r with x = rα, r the lever
/// at angle 0, ρ the lever at α over r, α₀ where the arm hangs and q the antagonist's lever over
/// the agonist's; T ≥ 0 are the muscles' tensions at the contractions ∫ρ dx and −q ∫ρ dx. Steps
/// like NonlinearPlant. A step of the mechanics uses the muscles that are taut at its beginning,
/// and the levers at its beginning and its expected end.
class JointPlant {
 public:
  /// step_s > 0, the tick; settings as their comments say, with valid muscles.
  JointPlant(const JointPlantSettings& settings, double step_s);

  /// One tick. load_Nm turns the joint towards negative angles.
  void step(double agonist_W, double antagonist_W, double load_Nm = 0.0);
  /// Replaces the settings; the muscles' state is kept.
  void set(const JointPlantSettings& settings);

  const JointPlantSettings& settings() const { return settings_; }
  /// The agonist's contraction.
  double position_m() const { return contraction_m(motion_.position_m); }
  /// Contraction of either muscle; 0: the agonist.
  double position_m(std::size_t muscle) const { return direction_[muscle] * position_m(); }
  /// The angle times the lever at angle 0: what the angle sensor reads.
  double reading_m() const { return motion_.position_m; }
  /// That reading at the lever of either muscle, with its sign.
  double reading_m(std::size_t muscle) const { return direction_[muscle] * reading_m(); }
  double angle_rad() const { return motion_.position_m / radius_m_; }
  double velocity_rad_per_s() const { return motion_.velocity_m_per_s / radius_m_; }
  /// Above the air at the start; 0: the agonist.
  double temperature_rise_K(std::size_t muscle) const { return bodies_[muscle].rise_K(); }
  /// The muscle's highest rise so far.
  double peak_temperature_rise_K(std::size_t muscle) const { return bodies_[muscle].peak_rise_K(); }
  /// At the end of the last step; 0: slack.
  double tension_N(std::size_t muscle) const { return tension_N_[muscle]; }

 private:
  using Drives = std::array<Drive, 2>;
  /// How a muscle's pull acts along x: lever ratio, and contraction minus ratio·x.
  struct Leverage {
    double ratio = 1.0;
    double beside_m = 0.0;
  };

  double contraction_m(double reading_m) const {
    return settings_.lever.is_constant() ? reading_m : settings_.lever.arc_m(reading_m / radius_m_);
  }
  Leverage leverage(double reading_m) const;
  /// Both moments are equal at the angle 0.
  double pretension_N(std::size_t muscle) const {
    return settings_.pretension_N / std::abs(direction_[muscle]);
  }

  /// lever_ratio: lever over the lever at angle 0.
  void set_mechanics(std::size_t taut, double lever_ratio);
  void slow_step(const std::array<double, 2>& power_W, double load_N);
  void move(Drives drives, double load_N);
  void pull(const Drives& drives, double reading_m);
  double weight_N(double reading_m) const;

  JointPlantSettings settings_;
  double radius_m_ = 0.015;  ///< lever at angle 0
  /// The agonist contracts with the joint's arc, the antagonist against it, at its own lever.
  std::array<double, 2> direction_{1.0, -1.0};
  SlowSteps slow_;
  double per_substep_ = 0.25;
  std::array<MuscleBody, 2> bodies_;
  std::array<bool, 2> pulls_{};  ///< present and not torn
  std::array<double, 2> slack_m_{};
  double max_stiffness_N_per_m_ = 0.0;
  /// Indexed by the taut muscles, as bits: a slack muscle does not damp. For the lever at angle 0,
  /// or, if the lever depends on the angle, for the ratio that was set last.
  std::array<Mechanics, 4> mechanics_;
  std::array<double, 4> damping_Ns_per_m_{};
  std::array<double, 2> muscle_damping_Ns_per_m_{};
  GuideFriction friction_;
  std::array<double, 2> tension_N_{};
  Motion motion_;  ///< of x
};

}  // namespace supercoil::host_sim
