// A board with one joint, as a configuration's file starts it, under an attack.
#pragma once

#include "attack/attacked_board.hpp"
#include "attack/joint_attack.hpp"

namespace supercoil::test {

class AttackedJoint final : public AttackedBoard {
 public:
  /// muscle: each of the two.
  AttackedJoint(const JointAttack& attack, const Muscle& muscle, JointActivity activity);

 private:
  void begin_attack() override;
  void command() override;
  void command_active();
  void follow(double ratio);

  JointAttack attack_;
  Muscle muscle_;
  JointActivity activity_;
  double reach_m_;  ///< where max_W of the agonist holds the joint
};

}  // namespace supercoil::test
