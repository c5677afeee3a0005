// The whole firmware, commanded over CAN.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <CppUTest/TestHarness.h>

#include "loop/support/can_rig.hpp"
#include "text/program_version.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(OverCan) {
  CanRig rig;
  Master master;
  Master other;

  void setup() override {
    other.name = 0x4321;
  }
  static bool is_heartbeat(std::uint16_t id) {
    return id == SUPERCOIL_STATUS_FRAME_ID || id == SUPERCOIL_STATUS_FRAME_ID + 1;
  }
  /// Renews every 50 ms.
  void hold(double time_s) {
    for (long i = std::lround(time_s / 0.05); i > 0; --i) {
      CHECK(rig.command(master, Verb::renew) == Refusal::none);
      rig.run(0.048);
    }
  }
};

TEST(OverCan, CommandExpiresWhenTheMasterFallsSilent) {
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
  LONGS_EQUAL(1, rig.first_causes.size());
  supercoil_first_cause_t cause{};
  supercoil_first_cause_unpack(&cause, rig.first_causes[0].data.data(), rig.first_causes[0].length);
  DOUBLES_EQUAL(0.25, cause.limit, 1e-6);
  DOUBLES_EQUAL(0.25, cause.measured, 0.002);
}

TEST(OverCan, ASecondMasterIsRefusedAndMayStop) {
  rig.start(master);
  CHECK(rig.claim(other) == Refusal::not_lease_holder);
  other.session = 0x5555;
  CHECK(rig.command(other, Verb::position, 0.02F) == Refusal::not_lease_holder);
  hold(0.2);
  CHECK(rig.command(other, Verb::disarm) == Refusal::none);
  CHECK(rig.state() == State::disarmed);
  rig.run(0.002);
  DOUBLES_EQUAL(0.0, rig.true_power_W(), 0.0);
}

TEST(OverCan, MasterReceivesTheLoopsRefusal) {
  rig.start(master);
  CHECK(rig.command(master, Verb::position, 0.5F) == Refusal::out_of_range);
  CHECK(rig.command(master, Verb::arm) == Refusal::wrong_state);
  LONGS_EQUAL(static_cast<int>(Verb::arm), rig.answers.back().opcode);
}

TEST(OverCan, EachNodeReportsItsOwnMuscle) {
  for (const unsigned place : {0U, 1U}) {
    const auto asking = static_cast<std::uint16_t>(SUPERCOIL_MUSCLE_READ_FRAME_ID + place);
    rig.bus.deliver({asking, 1, {known_cold_resistance}, {}});
    rig.run(0.02);
    CHECK(rig.last_of.contains(static_cast<std::uint16_t>(SUPERCOIL_MUSCLE_FRAME_ID + place)));
    CHECK_EQUAL(place == 1U, rig.last_of.contains(SUPERCOIL_MUSCLE_FRAME_ID + 1));
  }
}

TEST(OverCan, EachNodeSendsItsProgramVersionOncePerSecond) {
  rig.run(10.0);
  DOUBLES_EQUAL(10, rig.received_count[SUPERCOIL_BOOT_FRAME_ID], 1);
  DOUBLES_EQUAL(10, rig.received_count[SUPERCOIL_BOOT_FRAME_ID + 1], 1);
  supercoil_boot_t received{};
  const hal::CanFrame& frame = rig.last_of[SUPERCOIL_BOOT_FRAME_ID];
  LONGS_EQUAL(0, supercoil_boot_unpack(&received, frame.data.data(), frame.length));
  const hal::CanFrame expected = telemetry::boot(1, program_version());
  MEMCMP_EQUAL(expected.data.data(), frame.data.data(), frame.length);
  const int before = rig.received_count[SUPERCOIL_BOOT_FRAME_ID];
  for (int i = 0; i < 10'000; ++i)
    rig.link.poll(rig.board.now() + i * std::chrono::milliseconds(1));
  CHECK(rig.received_count[SUPERCOIL_BOOT_FRAME_ID] <= before + 1);
}

/// Asking needs no lease; once calibrate has found something, that is what the board reports.
TEST(OverCan, ReportsKnownMuscleQuantities) {
  const ChannelSettings& channel = rig.settings.firmware.channels[0];
  rig.run(1.0);
  DOUBLES_EQUAL(channel.muscle.thermal_mass_J_per_K, rig.muscle(0), 1e-6);
  DOUBLES_EQUAL(channel.muscle.force_per_kelvin_N_per_K, rig.muscle(5), 1e-6);
  DOUBLES_EQUAL(channel.calibration.cold_resistance_Ohm, rig.muscle(known_cold_resistance), 1e-6);
  CHECK(std::isnan(rig.muscle(known_unexplained_ratio)));
  DOUBLES_EQUAL(channel.muscle.thermal_mass_J_per_K, rig.muscle(known_configured), 1e-6);
  CHECK(std::isnan(rig.muscle(known_quantities.size())));
  CHECK(std::isnan(rig.muscle(255)));
  rig.run(15.0);
  rig.claim(master);
  rig.command(master, Verb::arm);
  rig.run(0.5);
  CHECK(rig.command(master, Verb::calibrate) == Refusal::none);
  const auto goes_on = [&] { return rig.loop.channel(0).snapshot().mode == Mode::calibrate; };
  for (int i = 0; i < 600 && goes_on(); ++i)
    hold(0.1);
  CHECK(rig.loop.channel(0).snapshot().result == ModeResult::found);
  const double found_Ohm = rig.muscle(known_cold_resistance);
  DOUBLES_EQUAL(channel.calibration.cold_resistance_Ohm, found_Ohm, 0.5);
  CHECK(found_Ohm != channel.calibration.cold_resistance_Ohm);
  // The file's value is reported beside it.
  DOUBLES_EQUAL(channel.heater.cold_resistance_Ohm, rig.muscle(known_joint_lever - 1), 1e-6);
  CHECK(std::isnan(rig.muscle(known_joint_lever)));
}

TEST(OverCan, ARefusedValueComesWithTheNearestAcceptedOne) {
  rig.start(master);
  const auto max_m = static_cast<float>(rig.settings.firmware.channels[0].supervision.max_travel_m);
  struct Refused {
    std::uint8_t opcode;
    float value;
    float nearest;
  };
  const std::array<Refused, 4> all{{{static_cast<std::uint8_t>(Verb::position), 0.5F, max_m},
                                    {static_cast<std::uint8_t>(Verb::position), -0.5F, -max_m},
                                    {static_cast<std::uint8_t>(Verb::controller), 77.0F, 2.0F},
                                    {static_cast<std::uint8_t>(Verb::estimator), -1.0F, 0.0F}}};
  for (const Refused& refused : all) {
    rig.refused_values.clear();
    CHECK(rig.command(master, refused.opcode, refused.value) == Refusal::out_of_range);
    rig.tick();
    LONGS_EQUAL(1, rig.refused_values.size());
    DOUBLES_EQUAL(refused.value, rig.refused_values[0].value, 0.0);
    DOUBLES_EQUAL(refused.nearest, rig.refused_values[0].nearest, 0.0);
    if (refused.opcode == static_cast<std::uint8_t>(Verb::position))
      CHECK(rig.command(master, Verb::position, refused.nearest) == Refusal::none);
  }
  // There is no nearest value to offer: the refusal carries the value as sent, and nothing else.
  rig.refused_values.clear();
  CHECK(rig.command(master, Verb::power, NAN) == Refusal::out_of_range);
  rig.tick();
  CHECK(std::isnan(rig.refused_values.at(0).value) && std::isnan(rig.refused_values.at(0).nearest));
  // A refusal that is not about a value carries none.
  rig.refused_values.clear();
  CHECK(rig.command(master, Verb::arm) == Refusal::wrong_state);
  rig.run(0.01);
  LONGS_EQUAL(0, rig.refused_values.size());
}

TEST(OverCan, CommandsThatOverflowTheQueueAreStillAnswered) {
  rig.run(0.1);
  rig.claim(master);
  // A program on the board itself has filled the loop's ring.
  while (rig.loop.send({0, Verb::disarm})) {
  }
  rig.answers.clear();
  rig.refused_values.clear();
  for (int i = 0; i < 5; ++i)
    rig.bus.deliver(master.frame(Verb::renew));
  rig.link.poll(rig.board.now());
  rig.run(0.05);
  LONGS_EQUAL(5, rig.answers.size());
  for (const auto& answer : rig.answers)
    CHECK(static_cast<Refusal>(answer.refusal) == Refusal::queue_full);
  LONGS_EQUAL(0, rig.refused_values.size());
  // Later commands get answers of their own.
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

TEST(OverCan, BusLossIsAFaultAndItsRecoveryIsNot) {
  rig.start(master);
  for (const hal::CanState lost : {hal::CanState::bus_off, hal::CanState::down}) {
    rig.bus.link = lost;
    rig.run(0.003);
    CHECK(rig.fault() == Fault::bus_off);
    DOUBLES_EQUAL(0.0, rig.true_power_W(), 0.0);
    CHECK(rig.link.publisher().dropped() > 0);
    rig.bus.link = hal::CanState::active;
    const long before = rig.received_frames;
    rig.run(1.0);
    CHECK(rig.received_frames - before > 300);
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

TEST(OverCan, ABusyBusOnlyDropsOldFrames) {
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
      // Any frame but the board's own heartbeat, which is node_conflict.
      do {
        frame.id = static_cast<std::uint16_t>(random() % 0x800U);
      } while (is_heartbeat(frame.id));
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

/// What a program that knows version 3 of the protocol sends and hears.
TEST(OverCan, AClientOfVersion3IsRefusedAndCanStillDisarm) {
  rig.start(master);
  constexpr std::uint8_t claim_of_3 = 14;
  other.session = other.name;
  CHECK(rig.command(other, claim_of_3) == Refusal::protocol_mismatch);
  // The client takes this for its answer, but not for a lease.
  const supercoil_acknowledge_t answer = rig.answers.back();
  LONGS_EQUAL(other.name, answer.session);
  LONGS_EQUAL(claim_of_3, answer.opcode);
  LONGS_EQUAL(0, answer.granted);
  CHECK(rig.command(other, Verb::position, 0.02F) == Refusal::not_lease_holder);
  // The heartbeat names the version where version 3 had it.
  hold(0.3);
  LONGS_EQUAL(5, rig.last_of.at(SUPERCOIL_STATUS_FRAME_ID).data[6]);
  CHECK(rig.state() == State::active);
  CHECK(rig.command(other, Verb::disarm) == Refusal::none);
  CHECK(rig.state() == State::disarmed);
}

TEST(OverCan, AReplayedSessionGetsNoLeaseAndNoHeat) {
  std::vector<hal::CanFrame> recorded;
  Master recording = master;
  rig.run(16.0);
  for (int claims = 0; claims < 2; ++claims) {
    const float nonce =
        claims == 0 ? telemetry::claim_value : static_cast<float>(rig.answers.back().granted);
    recording.session = recording.name;
    recorded.push_back(recording.frame(telemetry::Opcode::lease, nonce));
    rig.answers.clear();
    rig.bus.deliver(recorded.back());
    rig.run(0.02);
  }
  recording.session = rig.answers.back().granted;
  for (const auto& [verb, value] : {std::pair{Verb::arm, 0.0F}, std::pair{Verb::power, 2.0F}}) {
    recorded.push_back(recording.frame(verb, value));
    rig.bus.deliver(recorded.back());
    rig.run(0.2);
  }
  CHECK(rig.true_power_W() > 0.5);
  CHECK(rig.command(recording, Verb::disarm) == Refusal::none);
  rig.run(1.1);  // the lease ends

  rig.answers.clear();
  for (int times = 0; times < 5; ++times) {
    for (const hal::CanFrame& frame : recorded) {
      rig.bus.deliver(frame);
      rig.run(0.02);
      DOUBLES_EQUAL(0.0, rig.true_power_W(), 0.0);
    }
  }
  for (const auto& answer : rig.answers)
    CHECK(answer.refusal != 0);
}

TEST(OverCan, TheHeartbeatOfAnotherNodeIsNotAConflict) {
  rig.start(master);
  hal::CanFrame heartbeat;
  heartbeat.id = SUPERCOIL_STATUS_FRAME_ID + 2;
  heartbeat.length = SUPERCOIL_STATUS_LENGTH;
  rig.bus.deliver(heartbeat);
  hold(0.5);
  CHECK(rig.state() == State::active);
}
