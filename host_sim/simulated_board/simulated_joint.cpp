#include "simulated_board/simulated_joint.hpp"

namespace supercoil::host_sim {

namespace {

JointMuscle muscle_of(const MuscleChannel& channel) {
  return {channel.settings().plant, channel.settings().effects, channel.faults.torn};
}

}  // namespace

SimulatedJoint::SimulatedJoint(const SimulatedJointSettings& settings, MuscleChannel& agonist,
                               MuscleChannel& antagonist, hal::Duration step)
    : settings_(settings),
      agonist_(&agonist),
      antagonist_(&antagonist),
      plant_(plant_settings(), hal::seconds(step)) {
  agonist.join(plant_, 0);
  antagonist.join(plant_, 1);
}

JointPlantSettings SimulatedJoint::plant_settings() const {
  JointPlantSettings plant = settings_.plant;
  plant.agonist = muscle_of(*agonist_);
  plant.antagonist = muscle_of(*antagonist_);
  return plant;
}

void SimulatedJoint::set(const SimulatedJointSettings& settings) {
  settings_ = settings;
  agonist_torn_ = agonist_->faults.torn;
  antagonist_torn_ = antagonist_->faults.torn;
  plant_.set(plant_settings());
}

void SimulatedJoint::advance() {
  const bool tears =
      agonist_->faults.torn != agonist_torn_ || antagonist_->faults.torn != antagonist_torn_;
  if (tears) set(settings_);
  plant_.step(agonist_->true_power_W(), antagonist_->true_power_W(), settings_.load_Nm);
}

}  // namespace supercoil::host_sim
