// What the board's light shows (docs/wiring.md): off, on, slow and fast blinking.
#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(Light) {
  Rig rig{rough_board(1000.0)};

  bool lit() const {
    return rig.board.light.high();
  }
  /// Edges of the light in two seconds.
  long edges() {
    const auto before = rig.board.light.edges();
    rig.run(2.0);
    return static_cast<long>(rig.board.light.edges() - before);
  }
};

TEST(Light, IsOffWhileNothingIsArmed) {
  rig.boot();
  LONGS_EQUAL(0, edges());
  CHECK_FALSE(lit());
}

TEST(Light, IsOnWhenArmedAndBlinksWhenActive) {
  rig.boot();
  rig.arm();
  rig.run(0.5);
  CHECK(lit());
  LONGS_EQUAL(0, edges());
  rig.task = Task::power;
  rig.send(Verb::power, 0.5);
  rig.run(0.5);
  CHECK(rig.state() == State::active);
  LONGS_EQUAL(4, edges());
}

TEST(Light, BlinksWhenOneOfTwoMusclesIsActive) {
  rig.boot();
  rig.start_neighbour();
  rig.run(1.0);
  CHECK(rig.state() == State::disarmed);
  LONGS_EQUAL(4, edges());
}

TEST(Light, BlinksFastInAFault) {
  rig.boot();
  rig.board.stop_circuit.level.high = false;
  rig.run(0.1);
  CHECK(rig.loop.board_fault() == Fault::emergency_stop);
  LONGS_EQUAL(20, edges());
}

/// Behind a slow driver, a write costs the tick time.
TEST(Light, IsWrittenOnlyWhenItChanges) {
  class CountedLight final : public hal::DigitalOutput {
   public:
    hal::Status set(bool high) override {
      lit = high;
      ++writes;
      return hal::Status::ok;
    }
    bool lit = true;
    int writes = 0;
  } light;
  const RigSettings settings = rough_board();
  host_sim::SimulatedBoard board(settings.board);
  board::Devices devices = board.devices();
  devices.light = &light;
  Loop loop(settings.firmware, devices);
  Executive executive(loop, board, settings.firmware.rate_Hz);
  // The first tick switches off whatever it showed before.
  for (int i = 0; i < 300; ++i)
    executive.run_tick();
  CHECK_FALSE(light.lit);
  LONGS_EQUAL(1, light.writes);
  board.stop_circuit.level.high = false;
  for (int i = 0; i < 2000; ++i)
    executive.run_tick();
  LONGS_EQUAL(21, light.writes);
}
