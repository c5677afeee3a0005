#include "apps/supercoil/setup/steps.hpp"

namespace supercoil::operating {

std::string left_out(const SetupStep& step, const BoardSettings& board, std::size_t channel) {
  using InJoint = SetupStep::InJoint;
  if (board.channels[channel].bundle.follows() && !step.of_each_in_bundle) {
    return "channel " + std::to_string(channel + 1) +
           " follows in a bundle: set up the one that leads it instead, --channel " +
           std::to_string(board.bundle_of(channel)->leader() + 1);
  }
  const JointSettings* joint = board.joint_of(channel);
  if (joint == nullptr || step.in_joint == InJoint::of_each) return "";
  const std::string which = "channel " + std::to_string(channel + 1);
  if (step.in_joint == InJoint::never)
    return which + " turns a joint: the file's m_per_count and lever_m are its scale";
  if (joint->agonist == channel) return "";
  return which + " is a joint's antagonist: set up its agonist instead, --channel " +
         std::to_string(joint->agonist + 1);
}

}  // namespace supercoil::operating
