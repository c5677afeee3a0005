// A channel that is armed, for tests of its axis.
#pragma once

#include <optional>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

namespace supercoil::test {

/// The rig is made, from the settings, when it is first used.
struct AxisCase : Utest {
  RigSettings settings = rough_board();
  std::optional<Rig> rig_;

  Rig& rig() {
    if (!rig_) {
      rig_.emplace(settings);
      rig_->boot();
      rig_->arm();
      rig_->run(0.2);
    }
    return *rig_;
  }
  Refusal answer_to(Verb verb, double value = 0.0) { return rig().answer_to(verb, value); }
  /// The motion in the current window of heater_not_responding.
  double moved_m() {
    return rig().loop.channel(0).verdict().margin(Fault::heater_not_responding).measured;
  }
  board::LearnedUpdate update() {
    board::LearnedUpdate update;
    CHECK_TRUE(rig().loop.channel(0).take_learned_update(update));
    return update;
  }
};

}  // namespace supercoil::test
