// Two muscles of the board that turn one joint, or one against a spring or gravity.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "plant/joint_plant.hpp"
#include "simulated_board/muscle_channel.hpp"

namespace supercoil::host_sim {

struct SimulatedJointSettings {
  std::size_t agonist = 0;                    ///< its channel
  std::optional<std::size_t> antagonist = 1;  ///< its channel; empty: the agonist is alone
  JointPlantSettings
      plant;             ///< its muscles are the channels' own, torn and slack as their faults say
  double load_Nm = 0.0;  ///< turns the joint towards negative angles
};

/// The agonist's position sensor is the joint's; the antagonist's channel reads it as well.
class SimulatedJoint final : public SharedMotion {
 public:
  /// The channels are those of the settings and must outlive it. antagonist: null if the settings
  /// have none.
  SimulatedJoint(const SimulatedJointSettings& settings, MuscleChannel& agonist,
                 MuscleChannel* antagonist, hal::Duration step);

  /// 0: the agonist's.
  double position_m(std::size_t muscle) const override { return plant_.position_m(muscle); }
  double reading_m(std::size_t muscle) const override { return plant_.reading_m(muscle); }
  double temperature_rise_K(std::size_t muscle) const override {
    return plant_.temperature_rise_K(muscle);
  }
  double peak_temperature_rise_K(std::size_t muscle) const override {
    return plant_.peak_temperature_rise_K(muscle);
  }

  /// One step of the board, after both channels have been heated.
  void advance();
  /// Changes all settings that may change during a run, including the channels' muscles, but not
  /// which channels they are.
  void set(const SimulatedJointSettings& settings);

  const JointPlant& plant() const { return plant_; }
  const SimulatedJointSettings& settings() const { return settings_; }

 private:
  /// How a muscle is joined to the lever: torn, slack in m.
  using Hold = std::pair<bool, double>;

  std::array<Hold, 2> held() const;
  JointPlantSettings plant_settings() const;

  SimulatedJointSettings settings_;
  MuscleChannel* agonist_;
  MuscleChannel* antagonist_;
  std::array<Hold, 2> joined_{};  ///< as last set in the plant
  JointPlant plant_;
};

}  // namespace supercoil::host_sim
