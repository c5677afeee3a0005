// The whole firmware, commanded over CAN.
#include <algorithm>
#include <random>

#include <CppUTest/TestHarness.h>

#include "loop/support/can_rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(OverCan) {
  CanRig rig;
  Master master;
  Master other;

  void setup() override {
    other.nonce = 0x4321;
  }
  /// Renews every 50 ms.
  void hold(double time_s) {
    for (long i = std::lround(time_s / 0.05); i > 0; --i) {
      CHECK(rig.command(master, Verb::renew) == Refusal::none);
      rig.run(0.048);
    }
  }
};

TEST(OverCan, AMasterArmsMovesAndLetsGo) {
  rig.start(master);
  CHECK(rig.state() == State::active);
  hold(20.0);
  DOUBLES_EQUAL(0.012, rig.loop.channel(0).snapshot().position_m, 0.0005);
  CHECK(rig.true_power_W() > 0.5);
  // Silence: the command expires, and the heater is cold.
  rig.run(0.3);
  CHECK(rig.fault() == Fault::command_timeout);
  DOUBLES_EQUAL(0.0, rig.true_power_W(), 0.0);
  LONGS_EQUAL(1, rig.emergencies.size());
  LONGS_EQUAL(60, rig.emergencies[0].data[0]);
}

TEST(OverCan, ASecondMasterIsRefusedAndMayStop) {
  rig.start(master);
  CHECK(rig.claim(other) == Refusal::not_yours);
  other.session = 0x5555;
  CHECK(rig.command(other, Verb::position, 0.02F) == Refusal::not_yours);
  hold(0.2);
  CHECK(rig.command(other, Verb::disarm) == Refusal::none);
  CHECK(rig.state() == State::disarmed);
  rig.run(0.002);
  DOUBLES_EQUAL(0.0, rig.true_power_W(), 0.0);
}

TEST(OverCan, ARefusalOfTheLoopIsToldToTheMaster) {
  rig.start(master);
  CHECK(rig.command(master, Verb::position, 0.5F) == Refusal::out_of_range);
  CHECK(rig.command(master, Verb::arm) == Refusal::wrong_state);
  LONGS_EQUAL(static_cast<int>(Verb::arm), rig.answers.back().opcode);
}

TEST(OverCan, ACommandThatTheLoopCannotTakeIsAnsweredAllTheSame) {
  rig.run(0.1);
  rig.claim(master);
  // Somebody on the board itself has filled the loop's ring.
  while (rig.loop.send({0, Verb::disarm})) {
  }
  rig.answers.clear();
  for (int i = 0; i < 5; ++i)
    rig.bus.deliver(master.frame(Verb::renew));
  rig.link.poll(rig.board.now());
  rig.run(0.05);
  LONGS_EQUAL(5, rig.answers.size());
  for (const auto& answer : rig.answers)
    CHECK(static_cast<Refusal>(answer.refusal) == Refusal::too_many);
  // What comes later is answered for itself.
  CHECK(rig.command(master, Verb::renew) == Refusal::wrong_state);
}

TEST(OverCan, TenDamagedCommandsAreAFault) {
  rig.start(master);
  for (int i = 0; i < 10; ++i) {
    CHECK(rig.fault() == Fault::none);
    hal::CanFrame frame = master.frame(Verb::renew);
    frame.data[5] ^= 1U;
    rig.bus.deliver(frame);
    rig.run(0.002);
  }
  CHECK(rig.fault() == Fault::command_damaged);
}

TEST(OverCan, ABusThatIsLostIsAFaultAndItsComingBackIsNot) {
  rig.start(master);
  for (const hal::CanState lost : {hal::CanState::bus_off, hal::CanState::down}) {
    rig.bus.link = lost;
    rig.run(0.003);
    CHECK(rig.fault() == Fault::bus_off);
    DOUBLES_EQUAL(0.0, rig.true_power_W(), 0.0);
    CHECK(rig.link.publisher().dropped() > 0);
    rig.bus.link = hal::CanState::active;
    const long before = rig.heard;
    rig.run(1.0);
    CHECK(rig.heard - before > 300);
    rig.claim(master);
    CHECK(rig.command(master, Verb::reset) == Refusal::none);
    CHECK(rig.fault() == Fault::none);
  }
}

TEST(OverCan, AnErrorPassiveBusIsAFaultAfterASecond) {
  rig.start(master);
  rig.bus.link = hal::CanState::error_passive;
  hold(0.9);
  CHECK(rig.fault() == Fault::none);
  rig.run(0.2);
  CHECK(rig.fault() == Fault::bus_error_passive);
}

TEST(OverCan, ABusyBusCostsOldFramesAndNothingElse) {
  rig.start(master);
  rig.bus.refuses = true;
  rig.run(0.24);
  CHECK(rig.link.publisher().dropped() > 0);
  const std::uint32_t dropped = rig.link.publisher().dropped();
  rig.bus.refuses = false;
  hold(0.5);
  CHECK(rig.state() == State::active);
  LONGS_EQUAL(dropped, rig.link.publisher().dropped());
}

/// 8 frames a millisecond are more than a bus of 1 Mbit/s carries.
TEST(OverCan, AMillionRandomFramesDisturbNothing) {
  CanRig quiet;
  Master its_master;
  quiet.start(its_master);
  rig.start(master);
  std::mt19937 random(20261120);
  for (int tick = 0; tick < 125'000; ++tick) {
    for (int i = 0; i < 8; ++i) {
      hal::CanFrame frame;
      frame.id = static_cast<std::uint16_t>(random() % 0x800U);
      frame.length = static_cast<std::uint8_t>(random() % 9U);
      for (std::uint8_t& byte : frame.data)
        byte = static_cast<std::uint8_t>(random());
      rig.bus.deliver(frame);
    }
    if (tick % 20 == 0) {
      const float position_m = 0.012F + 0.004F * std::sin(1e-3F * static_cast<float>(tick));
      rig.bus.deliver(master.frame(Verb::position, position_m));
      quiet.bus.deliver(its_master.frame(Verb::position, position_m));
    }
    rig.tick();
    quiet.tick();
    const Snapshot& here = rig.loop.channel(0).snapshot();
    const Snapshot& there = quiet.loop.channel(0).snapshot();
    CHECK(here.applied_W == there.applied_W && here.position_m == there.position_m);
  }
  CHECK(rig.state() == State::active);
  const auto obeyed = [](const CanRig& whose) {
    return std::count_if(whose.answers.begin(), whose.answers.end(), [](const auto& answer) {
      return answer.refusal == static_cast<std::uint8_t>(Refusal::none);
    });
  };
  LONGS_EQUAL(125'000 / 20 + 1, obeyed(quiet));
  LONGS_EQUAL(obeyed(quiet), obeyed(rig));
}
