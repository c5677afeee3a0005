#include "simulated_board/simulated_joint.hpp"

namespace supercoil::host_sim {

namespace {

JointMuscle muscle_of(const MuscleChannel& channel) {
  return {channel.settings().plant, channel.settings().effects, channel.faults.torn,
          channel.faults.slack_m};
}

}  // namespace

SimulatedJoint::SimulatedJoint(const SimulatedJointSettings& settings, MuscleChannel& agonist,
                               MuscleChannel* antagonist, hal::Duration step)
    : settings_(settings),
      agonist_(&agonist),
      antagonist_(antagonist),
      plant_(plant_settings(), hal::seconds(step)) {
  agonist.join(*this, 0);
  if (antagonist_ != nullptr) antagonist_->join(*this, 1);
}

JointPlantSettings SimulatedJoint::plant_settings() const {
  JointPlantSettings plant = settings_.plant;
  plant.agonist = muscle_of(*agonist_);
  plant.antagonist.reset();
  if (antagonist_ != nullptr) plant.antagonist = muscle_of(*antagonist_);
  return plant;
}

std::array<SimulatedJoint::Hold, 2> SimulatedJoint::held() const {
  const auto hold = [](const MuscleFaults& faults) { return Hold{faults.torn, faults.slack_m}; };
  return {hold(agonist_->faults), antagonist_ != nullptr ? hold(antagonist_->faults) : Hold{}};
}

void SimulatedJoint::set(const SimulatedJointSettings& settings) {
  settings_ = settings;
  joined_ = held();
  plant_.set(plant_settings());
}

void SimulatedJoint::advance() {
  if (held() != joined_) set(settings_);
  const double antagonist_W = antagonist_ != nullptr ? antagonist_->true_power_W() : 0.0;
  plant_.step(agonist_->true_power_W(), antagonist_W, settings_.load_Nm);
}

}  // namespace supercoil::host_sim
