// The process is killed, or the kernel hangs: nothing of the firmware runs any more.
#include <CppUTest/TestHarness.h>

#include "loop/support/situations.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr hal::Duration decay = std::chrono::milliseconds(20);

}  // namespace

TEST_GROUP(StoppedFirmware){};

TEST(StoppedFirmware, BetweenAnyTwoTicksLeavesTheSupplyOpenWithinTheDecay) {
  for (const SituationName& s : situations) {
    for (int after = 0; after < 25; ++after) {
      Rig rig(rough_board());
      bring_to(s.situation, rig);
      for (int i = 0; i < after; ++i)
        rig.tick();
      const hal::Time stopped = rig.board.true_time();
      rig.board.advance_to(stopped + decay + std::chrono::milliseconds(1));
      CHECK_FALSE(rig.board.supply_closed());
      DOUBLES_EQUAL(0.0, rig.muscle().true_power_W(), 0.0);
      // Whatever duty the PWM goes on with.
      rig.board.advance_to(stopped + std::chrono::seconds(2));
      DOUBLES_EQUAL(0.0, rig.muscle().true_power_W(), 0.0);
    }
  }
}

TEST(StoppedFirmware, DuringTheSelfTestLeavesTheSupplyOpen) {
  for (int after = 0; after < 400; after += 3) {
    Rig rig(rough_board());
    for (int i = 0; i < after; ++i)
      rig.tick();
    rig.board.advance_to(rig.board.true_time() + decay + std::chrono::milliseconds(1));
    CHECK_FALSE(rig.board.supply_closed());
  }
}

TEST(StoppedFirmware, ThatGoesOnAfterAStallHasAFaultAndDoesNotHeat) {
  Rig rig(rough_board());
  bring_to(Situation::pi, rig);
  rig.board.lose_in_tick(0.5);
  rig.run(0.6);
  CHECK(rig.fault() == Fault::overrun);
  for (int i = 0; i < 1000; ++i) {
    rig.tick();
    DOUBLES_EQUAL(0.0, rig.muscle().true_power_W(), 0.0);
  }
  CHECK_FALSE(rig.interval_missed);
}

TEST(StoppedFirmware, ForFewerPeriodsThanAreToleratedKeepsTheTemperatureInItsInterval) {
  Rig rig(rough_board());
  bring_to(Situation::power, rig);
  for (int i = 0; i < 2000; ++i) {
    if (i % 3 == 0) rig.board.lose_in_tick(3.5e-3);
    rig.tick();
  }
  CHECK(rig.state() == State::active);
  CHECK_FALSE(rig.interval_missed);
  CHECK_COMPARE(rig.loop.overruns(), >, 1000);
}
