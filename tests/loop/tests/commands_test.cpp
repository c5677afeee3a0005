#include <cmath>
#include <limits>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(Commands) {
  Rig rig{rough_board()};

  Refusal answer_to(Verb verb, double value = 0.0) {
    rig.last_refusal = Refusal::none;
    rig.send(verb, value);
    rig.tick();
    return rig.last_refusal;
  }
  void arm() {
    rig.boot();
    rig.arm();
    rig.run(0.2);
  }
};

TEST(Commands, ABoardBootsDisarmedWithPowerOff) {
  for (int i = 0; i < 1000; ++i) {
    rig.tick();
    CHECK(rig.state() == State::disarmed);
    DOUBLES_EQUAL(0.0, rig.muscle().true_power_W(), 0.0);
  }
}

TEST(Commands, ArmIsRefusedBeforeTheSelfTestPasses) {
  rig.run(0.01);
  CHECK(answer_to(Verb::arm) == Refusal::not_ready);
  CHECK(rig.state() == State::disarmed);
}

TEST(Commands, ArmIsRefusedBeforeTheSelfTestEvenForAColdMuscle) {
  RigSettings settings = rough_board();
  for (ChannelSettings& channel : settings.firmware.channels)
    channel.thermal.boot_rise_K = 0.0;
  Rig cold(settings);
  while (!cold.loop.self_test().passed()) {
    cold.last_refusal = Refusal::none;
    cold.send(Verb::arm);
    cold.tick();
    CHECK(cold.last_refusal == Refusal::not_ready);
    CHECK(cold.state() == State::disarmed);
  }
  cold.run_ticks(1);
  cold.arm();
  CHECK(cold.state() == State::armed);
}

TEST(Commands, ArmIsRefusedWhileTheMuscleMayStillBeHot) {
  rig.run_until([&] { return rig.loop.self_test().passed(); }, 2.0);
  const double full_power_to_C = rough_board().firmware.channels[0].limiter.derate_from_C;
  CHECK(rig.snapshot().hottest_C > full_power_to_C);
  while (rig.snapshot().hottest_C >= full_power_to_C) {
    CHECK(answer_to(Verb::arm) == Refusal::not_ready);
    rig.run(0.1);
  }
  rig.run_ticks(1);
  CHECK(answer_to(Verb::arm) == Refusal::none);
}

TEST(Commands, ArmingProbesTheHeaterAndMeasuresItsResistance) {
  arm();
  CHECK(rig.state() == State::armed);
  DOUBLES_EQUAL(10.0, rig.snapshot().resistance_Ohm, 0.5);
}

TEST(Commands, HeatingWhileTheProbeRunsIsRefusedAsBusy) {
  rig.boot();
  rig.arm();
  CHECK(answer_to(Verb::position, 0.01) == Refusal::busy);
}

TEST(Commands, AreRefusedInTheWrongState) {
  rig.boot();
  for (const Verb verb :
       {Verb::position, Verb::power, Verb::identify, Verb::renew, Verb::rest, Verb::reset}) {
    CHECK(answer_to(verb, takes(verb, 0.01) ? 0.01 : 0.0) == Refusal::wrong_state);
    answer_to(Verb::disarm);
  }
}

TEST(Commands, WithAnInvalidOrOutOfRangeValueAreRefused) {
  arm();
  for (const double wrong : {std::nan(""), 0.026, -0.1, std::numeric_limits<double>::infinity()}) {
    CHECK(answer_to(Verb::position, wrong) == Refusal::out_of_range);
  }
  CHECK(answer_to(Verb::power, std::nan("")) == Refusal::out_of_range);
  CHECK(answer_to(Verb::controller, 3) == Refusal::out_of_range);
  CHECK(answer_to(Verb::controller, std::nan("")) == Refusal::out_of_range);
  CHECK(answer_to(Verb::controller, 0.5) == Refusal::out_of_range);
  CHECK(answer_to(Verb::scale, -1.0) == Refusal::out_of_range);
  // For a muscle at rest this would be a scale of a thousand.
  CHECK(answer_to(Verb::scale, 0.5) == Refusal::out_of_range);
  CHECK(rig.state() == State::armed);
}

TEST(Commands, WithAnUnexpectedValueAreRefused) {
  rig.boot();
  for (const Verb verb :
       {Verb::arm, Verb::reset, Verb::renew, Verb::rest, Verb::identify, Verb::calibrate}) {
    for (const double value : {1.0, -1e-6, std::nan("")}) {
      CHECK_TEXT(answer_to(verb, value) == Refusal::out_of_range, std::string(name(verb)).c_str());
      DOUBLES_EQUAL(0.0, rig.last_nearest, 0.0);
    }
  }
  CHECK(rig.state() == State::disarmed);
  arm();
  CHECK(answer_to(Verb::disarm, 1.0) == Refusal::none);
  CHECK(rig.state() == State::disarmed);
}

TEST(Commands, ResetWithAValueDoesNotResetTheBoard) {
  rig.boot();
  rig.board.set_supply_V(5.0);
  rig.run(0.1);
  CHECK(rig.loop.board_fault() == Fault::under_voltage);
  rig.board.set_supply_V(12.0);
  rig.run(0.1);
  CHECK(answer_to(Verb::reset, 1.0) == Refusal::out_of_range);
  CHECK(rig.loop.board_fault() == Fault::under_voltage);
  CHECK(answer_to(Verb::reset) == Refusal::none);
  CHECK(rig.loop.board_fault() == Fault::none);
}

TEST(Commands, ToAMissingChannelAreRefused) {
  rig.boot();
  const auto channels = static_cast<std::uint8_t>(rig.loop.channels());
  for (const std::uint8_t none : {channels, std::uint8_t{7}, std::uint8_t{255}}) {
    rig.last_refusal = Refusal::none;
    rig.loop.send({none, Verb::arm, 0.0});
    rig.tick();
    CHECK(rig.last_refusal == Refusal::no_such_channel);
  }
}

TEST(Commands, ExpireWithoutRenewal) {
  arm();
  rig.heat(Task::position);
  rig.run(1.0);
  rig.commands_flow = false;
  rig.run(0.24);
  CHECK(rig.state() == State::active);
  rig.run(0.02);
  CHECK(rig.fault() == Fault::command_timeout);
  rig.run(0.05);
  DOUBLES_EQUAL(0.0, rig.muscle().true_power_W(), 0.0);
}

TEST(Commands, RenewKeepsTheLastCommandActive) {
  arm();
  rig.heat(Task::power);
  rig.task = Task::nothing;
  for (int i = 0; i < 20; ++i) {
    rig.send(Verb::renew);
    rig.run(0.2);
  }
  CHECK(rig.state() == State::active);
  DOUBLES_EQUAL(1.8, rig.snapshot().applied_W, 0.01);
}

TEST(Commands, ARefusedIdentifyDoesNotCancelTheRenewal) {
  arm();
  rig.heat(Task::position);
  rig.run(0.1);
  rig.task = Task::nothing;
  for (int i = 0; i < 1000; ++i) {
    rig.send(Verb::position, 0.005);
    CHECK(answer_to(Verb::identify) == Refusal::busy);
  }
  CHECK(rig.state() == State::active);
}

TEST(Commands, DisarmIsAcceptedWhileActive) {
  arm();
  rig.heat(Task::position);
  rig.run(1.0);
  rig.task = Task::nothing;
  CHECK(answer_to(Verb::disarm) == Refusal::none);
  CHECK(rig.state() == State::disarmed);
  rig.run(0.002);
  DOUBLES_EQUAL(0.0, rig.muscle().true_power_W(), 0.0);
  CHECK_FALSE(rig.muscle().enable.high());
}

TEST(Commands, ARefusedResetReportsTheReason) {
  rig.boot();
  rig.board.stop_circuit.level.high = false;
  rig.run(0.01);
  CHECK(answer_to(Verb::reset) == Refusal::cause_persists);
  rig.board.stop_circuit.level.high = true;
  CHECK(answer_to(Verb::reset) == Refusal::no_edge);
  rig.run(0.01);
  CHECK(answer_to(Verb::reset) == Refusal::none);
  CHECK(rig.state() == State::disarmed);
}

TEST(Commands, AnUnreadableStopCircuitCountsAsPressed) {
  arm();
  rig.board.stop_circuit.level = {true, hal::Status::gone};
  rig.run(0.002);
  CHECK(rig.fault() == Fault::emergency_stop);
}

TEST(Commands, ArmingInTheTickOfAResetWaitsForTheNewSelfTest) {
  rig.boot();
  rig.board.stop_circuit.level.high = false;
  rig.run(0.01);
  rig.board.stop_circuit.level.high = true;
  rig.run(0.01);
  rig.send(Verb::reset);
  CHECK(answer_to(Verb::arm) == Refusal::not_ready);
  CHECK(rig.state() == State::disarmed);
  rig.run(0.5);
  CHECK(answer_to(Verb::arm) == Refusal::none);
}

TEST(Commands, ScaleIsRefusedWhileAControllerFollowsAPosition) {
  arm();
  rig.heat(Task::position);
  rig.run(1.0);
  CHECK(answer_to(Verb::scale, 0.005) == Refusal::wrong_state);
}

TEST(Commands, ScaleIsRefusedWithoutAPosition) {
  rig.boot();
  rig.muscle().position.set(host_sim::ConverterFaults{.silent = true});
  rig.run(0.1);
  CHECK(answer_to(Verb::scale, 0.005) == Refusal::not_ready);
}

TEST(Commands, SkippedPeriodsCountTowardsTheCommandTimeout) {
  arm();
  rig.heat(Task::power);
  rig.run(1.0);
  rig.commands_flow = false;
  const double silent_since_s = rig.time_s();
  // Every other tick overruns by three periods: half of all periods are left out.
  for (int i = 0; rig.state() == State::active && i < 1000; ++i) {
    rig.board.lose_in_tick(3.1 * rig.period_s());
    rig.run_ticks(3);
  }
  CHECK(rig.fault() == Fault::command_timeout);
  DOUBLES_EQUAL(0.25, rig.time_s() - silent_since_s, 0.02);
}

TEST(Commands, EveryQueuedCommandIsAnswered) {
  rig.boot();
  long taken = 0;
  while (rig.loop.send({Rig::tested, Verb::disarm}))
    ++taken;
  CHECK_COMPARE(taken, >=, 256);
  long answered = 0;
  for (int i = 0; i < 10; ++i) {
    rig.executive.run_tick();
    for (Answer answer; rig.loop.answer(answer);)
      answered += answer.refusal == Refusal::none ? 1 : 0;
  }
  LONGS_EQUAL(taken, answered);
}
