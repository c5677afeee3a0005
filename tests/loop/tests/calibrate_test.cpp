// What calibrate hands over to be stored.
#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

RigSettings other_heater() {
  RigSettings settings = rough_board(1000.0);
  settings.board.channels[0].resistance_Ohm = 11.0;
  return settings;
}

}  // namespace

TEST_GROUP(Calibrate) {
  Rig rig{other_heater()};
  board::LearnedUpdate update;
};

TEST(Calibrate, FindsTheColdResistanceAndKeepsIt) {
  rig.boot();
  rig.arm();
  rig.run(0.5);
  rig.heat(Task::calibrate);
  CHECK(rig.run_until([&] { return rig.loop.channel(0).take_learned_update(update); }, 60.0));
  CHECK(rig.snapshot().result == ModeResult::found);
  DOUBLES_EQUAL(11.0, update->calibration.cold_resistance_Ohm, 0.5);
  CHECK(update->has_muscle);
  // So does what is stored later: the muscle is not forgotten meanwhile.
  rig.send(Verb::disarm);
  rig.run(0.1);
  rig.send(Verb::compare_supply, 0.0);
  CHECK(rig.run_until([&] { return rig.loop.channel(0).take_learned_update(update); }, 1.0));
  CHECK(update->has_muscle);
  DOUBLES_EQUAL(11.0, update->calibration.cold_resistance_Ohm, 0.5);
}
