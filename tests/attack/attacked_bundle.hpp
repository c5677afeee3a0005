// A board with a bundle of three muscles, as a configuration's file starts it, under an attack.
#pragma once

#include "attack/attacked_board.hpp"
#include "attack/bundle_attack.hpp"

namespace supercoil::test {

class AttackedBundle final : public AttackedBoard {
 public:
  /// muscle: each of the three.
  AttackedBundle(const BundleAttack& attack, const Muscle& muscle, BundleActivity activity);

 private:
  void begin_attack() override;
  void command() override;
  void command_active();
  void follow(double ratio);

  BundleAttack attack_;
  Muscle muscle_;
  BundleActivity activity_;
  double reach_m_;  ///< where max_W of each holds the load
};

}  // namespace supercoil::test
