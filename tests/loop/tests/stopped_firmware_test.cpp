// The process is killed, or the kernel hangs: nothing of the firmware runs any more.
#include <algorithm>

#include <CppUTest/TestHarness.h>

#include "loop/support/situations.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr hal::Duration decay = std::chrono::milliseconds(20);

}  // namespace

TEST_GROUP(StoppedFirmware){};
TEST_GROUP(SelfTestPower){};

TEST(StoppedFirmware, BetweenAnyTwoTicksOpensTheSupplyWithinTheDecay) {
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

TEST(StoppedFirmware, ThatResumesAfterAStallHasAFaultAndDoesNotHeat) {
  // After seconds the muscle has cooled, which only a firmware that counts them knows.
  for (const double stall_s : {0.05, 0.5, 5.0}) {
    Rig rig(rough_board());
    bring_to(Situation::pi, rig);
    rig.board.lose_in_tick(stall_s);
    rig.run(stall_s + 0.1);
    CHECK(rig.fault() == Fault::overrun);
    for (int i = 0; i < 1000; ++i) {
      rig.tick();
      DOUBLES_EQUAL(0.0, rig.muscle().true_power_W(), 0.0);
    }
    CHECK_FALSE(rig.interval_missed);
  }
}

TEST(StoppedFirmware, ForToleratedOverrunsKeepsTheTemperatureInItsInterval) {
  for (const double boot_rise_K : {135.0, 0.5}) {
    RigSettings settings = rough_board();
    settings.firmware.channels[0].thermal.boot_rise_K = boot_rise_K;
    Rig rig(settings);
    rig.boot();
    rig.arm();
    rig.run(0.2);
    rig.heat(Task::power);
    // From cold, the hot end leads by little and must not fall behind.
    for (int i = 0; i < 4000; ++i) {
      if (i % 3 == 0) rig.board.lose_in_tick(3.5e-3);
      rig.tick();
    }
    CHECK(rig.state() == State::active);
    CHECK_FALSE(rig.interval_missed);
    CHECK_COMPARE(rig.loop.overruns(), >, 1000);
  }
}

TEST(SelfTestPower, IsAtMostAProbesPowerWhenTheCutOffFails) {
  for (const bool pump_stuck : {true, false}) {
    const RigSettings settings = rough_board();
    const HeaterSettings& heater = settings.firmware.channels[0].heater;
    const double probe_W = heater.probe_duty * settings.board.supply_V * settings.board.supply_V /
                           heater.cold_resistance_Ohm;
    Rig rig(settings);
    rig.board.pump.stuck_closed = pump_stuck;
    rig.muscle().faults.enable_stuck_on = !pump_stuck;
    double max_W = 0.0;
    rig.run_until(
        [&] {
          max_W = std::max(max_W, rig.muscle().true_power_W());
          return rig.loop.self_test().failed();
        },
        5.0);
    CHECK(rig.loop.self_test().failed());
    CHECK_COMPARE(max_W, <=, 1.01 * probe_W);
    CHECK_COMPARE(max_W, >, 0.5 * probe_W);
  }
}
