// A joint that two muscles pull, or one against a spring or a weight.
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

/// Its parameters' moving mass counts for nothing here: the joint has an inertia.
struct JointMuscle {
  control::PhysicalParameters parameters;
  PlantEffects effects;
  bool torn = false;     ///< it pulls no more
  double slack_m = 0.0;  ///< of its cable: it contracts so far before it pulls as it did
};

/// The angle is zero where the new, cold agonist pulls with pretension_N, and the antagonist with
/// as much of a moment; the agonist turns the joint towards positive angles.
struct JointPlantSettings {
  JointMuscle agonist;
  std::optional<JointMuscle> antagonist;  ///< otherwise spring and weight oppose alone
  control::Lever lever;                   ///< of the agonist
  double antagonist_lever_ratio = 1.0;    ///< of its lever to the agonist's, at every angle
  double inertia_kg_m2 = 2e-5;
  double damping_Nms_per_rad = 0.0;  ///< beside the muscles'
  double spring_Nm_per_rad = 0.0;    ///< towards the angle 0, beside the muscles
  double pretension_N = 0.883;       ///< of the agonist
  bool spring_pretensions = true;    ///< without an antagonist it is the spring's as well
  double friction_ratio = 0.0;       ///< Coulomb friction at the lever over the pretension
  double weight_Nm = 0.0;            ///< of an arm, when it is level
  double hangs_at_rad = 0.0;         ///< where that would hang by itself
  double min_angle_rad = -1.5;       ///< end stops
  double max_angle_rad = 1.5;
  int substeps = 4;  ///< of the mechanics, in each step of heat
};

/// (I/r²) ẍ = ρ (T₁ − q T₂) − c ẋ − k x − (w sin(α − α₀) + load)/r with x = rα, r the lever
/// at the angle 0, ρ the lever at α over it, α₀ where the arm hangs and q the antagonist's lever
/// over the agonist's; T ≥ 0 are the muscles' tensions at the contractions ∫ρ dx and −q ∫ρ dx.
/// Steps as NonlinearPlant's. Which muscles are taut is asked at the beginning of each step of the
/// mechanics, their lever there and at its expected end.
class JointPlant {
 public:
  /// step_s > 0, the tick; settings as their comments say, with valid muscles.
  JointPlant(const JointPlantSettings& settings, double step_s);

  /// One tick. load_Nm turns the joint towards negative angles.
  void step(double agonist_W, double antagonist_W, double load_Nm = 0.0);
  /// From now on; whatever the muscles remember stays.
  void set(const JointPlantSettings& settings);

  const JointPlantSettings& settings() const { return settings_; }
  /// The agonist's contraction.
  double position_m() const { return contraction_m(motion_.position_m); }
  /// Likewise, of either muscle; 0: the agonist.
  double position_m(std::size_t muscle) const { return direction_[muscle] * position_m(); }
  /// The angle times the lever at 0: what the sensor of the angle reads.
  double reading_m() const { return motion_.position_m; }
  /// Likewise, at the lever of either muscle, with its sign.
  double reading_m(std::size_t muscle) const { return direction_[muscle] * reading_m(); }
  double angle_rad() const { return motion_.position_m / radius_m_; }
  double velocity_rad_per_s() const { return motion_.velocity_m_per_s / radius_m_; }
  /// 0: the agonist; above the air as it was at the start.
  double temperature_rise_K(std::size_t muscle) const { return bodies_[muscle].rise_K(); }
  /// The hottest that the muscle was.
  double peak_temperature_rise_K(std::size_t muscle) const { return bodies_[muscle].peak_rise_K(); }
  /// At the end of the last step; 0: slack.
  double tension_N(std::size_t muscle) const { return tension_N_[muscle]; }

 private:
  using Drives = std::array<Drive, 2>;
  /// A muscle's pull as it acts along x: by how much more, and its contraction beside ratio·x.
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

  /// lever_ratio: of the lever to the one at 0.
  void set_mechanics(std::size_t taut, double lever_ratio);
  void slow_step(const std::array<double, 2>& power_W, double load_N);
  void move(Drives drives, double load_N);
  void pull(const Drives& drives, double reading_m);
  double weight_N(double reading_m) const;

  JointPlantSettings settings_;
  double radius_m_ = 0.015;  ///< of the lever at the angle 0
  /// The agonist contracts with the joint's arc, the antagonist against it, at its own lever.
  std::array<double, 2> direction_{1.0, -1.0};
  SlowSteps slow_;
  double per_substep_ = 0.25;
  std::array<MuscleBody, 2> bodies_;
  std::array<bool, 2> pulls_{};  ///< there, and not torn
  std::array<double, 2> slack_m_{};
  double max_stiffness_N_per_m_ = 0.0;
  /// By which muscles are taut, as bits: a slack one does not damp. At the lever of the angle 0; of
  /// one that depends on it, as set last.
  std::array<Mechanics, 4> mechanics_;
  std::array<double, 4> damping_Ns_per_m_{};
  std::array<double, 2> muscle_damping_Ns_per_m_{};
  GuideFriction friction_;
  std::array<double, 2> tension_N_{};
  Motion motion_;  ///< of x
};

}  // namespace supercoil::host_sim
