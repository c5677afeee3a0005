#include "loop/channel.hpp"

#include <cmath>
#include <set>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(Channel) {
  Rig rig{rough_board()};

  void heat(double power_W) {
    rig.boot();
    rig.arm();
    rig.run(0.2);
    rig.send(Verb::power, power_W);
    rig.run(0.05);
    CHECK(rig.state() == State::active);
  }
  void damage_in_a_row(int commands) {
    for (int i = 0; i < commands; ++i) {
      CHECK(rig.loop.send_damaged(Rig::tested));
      rig.tick();
    }
  }
};

TEST(Channel, SnapshotIsZeroBeforeTheFirstTick) {
  const Snapshot& s = rig.snapshot();
  for (const double value :
       {s.oscillation_period_s, s.reference, s.model_m, s.position_m, s.demanded_W, s.applied_W,
        s.duty, s.supply_V, s.current_A, s.resistance_Ohm, s.resistance_age_s, s.coldest_C,
        s.hottest_C, s.error_bound, s.bias_W, s.bias_deviation_W})
    DOUBLES_EQUAL(0.0, value, 0.0);
  LONGS_EQUAL(0, s.controller);
  LONGS_EQUAL(0, s.multiplexed_selector);
  CHECK(s.state == State::disarmed && s.mode == Mode::rest && s.fault == Fault::none);
}

TEST(Channel, PublishesEveryDetectorsMarginWithin55Ticks) {
  rig.boot();
  std::set<Fault> published;
  for (int i = 0; i < 55; ++i) {
    rig.tick();
    const Snapshot& s = rig.snapshot();
    published.insert(s.margin_selector);
    if (s.margin_selector != Fault::over_temperature) continue;
    DOUBLES_EQUAL(s.hottest_C, s.margin.measured, 0.1);
    DOUBLES_EQUAL(160.0, s.margin.limit, 0.0);
  }
  UNSIGNED_LONGS_EQUAL(all_faults().size(), published.size());
}

TEST(Channel, PublishesTheMarginOfABoardFault) {
  heat(1.0);
  rig.board.set_supply_V(9.0);
  CHECK(rig.run_until([&] { return rig.fault() == Fault::under_voltage; }, 1.0));
  const Snapshot& s = rig.snapshot();
  CHECK(s.margin_selector == Fault::under_voltage);
  DOUBLES_EQUAL(9.0, s.margin.measured, 0.5);
  CHECK_COMPARE(s.margin.measured, <, s.margin.limit);
}

TEST(Channel, PublishesTheMarginOfABusFault) {
  rig.boot();
  rig.arm();
  // Reported for each channel, but judged once for the whole board.
  rig.loop.health().bus.store(hal::CanState::error_passive);
  CHECK(rig.run_until([&] { return rig.fault() == Fault::bus_error_passive; }, 10.0));
  const Snapshot& s = rig.snapshot();
  CHECK(s.margin_selector == Fault::bus_error_passive);
  DOUBLES_EQUAL(rough_board().firmware.supervision.bus_error_passive_s, s.margin.limit, 1e-12);
  DOUBLES_EQUAL(s.margin.limit, s.margin.measured, 0.01);
}

TEST(Channel, OnlyAnAcceptedCommandResetsTheDamagedCount) {
  heat(1.0);
  for (int i = 0; i < 3; ++i) {
    damage_in_a_row(9);
    CHECK(rig.fault() == Fault::none);
    rig.send(Verb::renew);
    rig.tick();
  }
  damage_in_a_row(9);
  rig.send(Verb::arm);  // refused: the row goes on
  rig.tick();
  CHECK(rig.last_refusal == Refusal::wrong_state);
  CHECK(rig.fault() == Fault::none);
  damage_in_a_row(1);
  CHECK(rig.fault() == Fault::command_damaged);
}

TEST(Channel, KeepsToItsPowerRange) {
  heat(3.0);
  DOUBLES_EQUAL(3.0, rig.snapshot().applied_W, 0.01);
  rig.loop.channel(Rig::tested).set_power_range(0.2, 1.0);
  DOUBLES_EQUAL(1.0, rig.loop.channel(Rig::tested).max_power_W(), 0.0);
  for (const auto& [wanted_W, given_W] :
       {std::pair{3.0, 1.0}, std::pair{0.7, 0.7}, std::pair{0.0, 0.2}}) {
    rig.send(Verb::power, wanted_W);
    rig.run(0.05);
    DOUBLES_EQUAL(given_W, rig.snapshot().applied_W, 0.01);
  }
}
