// How the loop uses readings and its own duties: which channel they belong to, whether they are
// present, and when they act.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr double max_boot_s = 2.0;

bool completes_self_test(Rig& rig) {
  return rig.run_until(
      [&] { return rig.loop.self_test().passed() || rig.loop.self_test().failed(); }, max_boot_s);
}

}  // namespace

TEST_GROUP(Senses) {
  Rig rig{rough_board()};
};

TEST(Senses, SelfTestChecksTheCurrentOfEveryChannel) {
  for (const std::size_t broken : {0U, 1U}) {
    Rig each(rough_board());
    each.board.channel(broken).faults.switch_stuck_on = true;
    CHECK(completes_self_test(each));
    CHECK(each.loop.self_test().outcome() == SelfTest::Outcome::enable_does_not_cut);
    each.run_ticks(2);
    CHECK(each.loop.board_fault() == Fault::self_test_failed);
  }
}

TEST(Senses, SelfTestWaitsForTheFirstCurrentOfEveryChannel) {
  for (const std::size_t late : {0U, 1U}) {
    Rig each(rough_board());
    each.board.channel(late).current.set({.status = hal::Status::not_ready});
    // Within the time for which converters may be without a value.
    for (int i = 0; i < 95; ++i) {
      each.tick();
      CHECK(each.loop.self_test().outcome() == SelfTest::Outcome::waiting);
      CHECK_FALSE(each.board.supply_closed());
    }
    each.board.channel(late).current.set(host_sim::ConverterFaults{});
    CHECK(completes_self_test(each));
    CHECK(each.loop.self_test().passed());
    CHECK(each.fault() == Fault::none);
  }
}

TEST(Senses, AProbeReportsAnOpenHeaterAboveFourTimesTheColdResistance) {
  for (const double times : {3.3, 4.7}) {
    RigSettings settings = rough_board();
    settings.board.channels[0].resistance_Ohm *= times;
    Rig each(settings);
    each.boot();
    each.send(Verb::arm);
    each.run(0.2);
    CHECK(each.fault() == (times < 4.0 ? Fault::resistance_drift : Fault::heater_open));
  }
}

TEST(Senses, APositionOutOfRangeIsNotUsed) {
  rig.boot();
  rig.arm();
  rig.run(0.2);
  rig.heat(Task::position);
  rig.run(1.0);
  CHECK_FALSE(std::isnan(rig.snapshot().position_m));
  const control::Theta before = rig.snapshot().theta;
  rig.muscle().position.set({.loose = true});
  rig.tick();
  // One bad reading is not a fault yet, but it is used neither to control nor to learn.
  CHECK(rig.state() == State::active);
  CHECK(std::isnan(rig.snapshot().position_m));
  CHECK(rig.snapshot().theta == before);
  DOUBLES_EQUAL(0.0, rig.snapshot().demanded_W, 0.0);
  CHECK(rig.last_refusal == Refusal::none);
}

TEST(Senses, ReportedPowerIncludesThePwmDelay) {
  constexpr int delay_ticks = 7;
  RigSettings settings = rough_board();
  settings.firmware.channels[0].heater.delay_s = delay_ticks * settings.firmware.step_s();
  settings.board.channels[0].pwm_delay_s = settings.firmware.channels[0].heater.delay_s;
  Rig late(settings);
  late.boot();
  late.arm();
  late.run(0.2);
  late.send(Verb::power, 1.8);
  late.tick();
  CHECK_COMPARE(late.snapshot().duty, >, 0.05);
  for (int i = 0; i < delay_ticks; ++i) {
    DOUBLES_EQUAL(0.0, late.snapshot().applied_W, 0.0);
    late.tick();
  }
  DOUBLES_EQUAL(1.8, late.snapshot().applied_W, 0.01);
  late.tick();
  DOUBLES_EQUAL(late.muscle().true_power_W(), late.snapshot().applied_W, 0.1);
}

TEST(Senses, SkippedPeriodsCountInTheTemperature) {
  Rig slow(rough_board());
  for (Rig* each : {&rig, &slow})
    each->run(0.5);
  for (int i = 0; i < 40; ++i) {
    slow.board.lose_in_tick(3.1 * slow.period_s());
    slow.run_ticks(2);
  }
  rig.run(slow.time_s() - rig.time_s());
  CHECK_COMPARE(slow.loop.overruns(), >=, 100);
  DOUBLES_EQUAL(rig.time_s(), slow.time_s(), 1.5 * rig.period_s());
  DOUBLES_EQUAL(rig.snapshot().hottest_C, slow.snapshot().hottest_C, 0.1);
}

TEST(Senses, SkippedPeriodsAssumeTheHighestPossiblePower) {
  Rig slow(rough_board());
  for (Rig* each : {&rig, &slow}) {
    each->boot();
    each->arm();
    each->run(0.2);
    each->heat(Task::power);
    each->run(0.5);
  }
  for (int i = 0; i < 100; ++i) {
    slow.board.lose_in_tick(3.1 * slow.period_s());
    slow.run_ticks(3);
  }
  rig.run(slow.time_s() - rig.time_s());
  CHECK(slow.state() == State::active);
  DOUBLES_EQUAL(rig.time_s(), slow.time_s(), 1.5 * rig.period_s());
  CHECK_COMPARE(slow.snapshot().hottest_C, >=, rig.snapshot().hottest_C - 0.05);
}
