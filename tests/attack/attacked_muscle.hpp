// One muscle of a board, as a configuration's file starts it, under an attack.
#pragma once

#include "attack/attack.hpp"
#include "attack/attacked_board.hpp"

namespace supercoil::test {

class AttackedMuscle final : public AttackedBoard {
 public:
  AttackedMuscle(const Attack& attack, const Muscle& muscle, Activity activity);

 private:
  void begin_attack() override;
  void command() override;
  void command_active();

  Attack attack_;
  Muscle muscle_;
  Activity activity_;
};

}  // namespace supercoil::test
