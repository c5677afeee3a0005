// Which master holds the lease of which node, and which node speaks, on a bus or joint of several.
#include <array>
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "loop/support/can_rig.hpp"
#include "telemetry/joint_frame.hpp"
#include "unit/firmware/io/can/support/unpacked.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(NodesOnCan) {
  CanRig rig;
  Master master;
};

/// Each hears what the other sends, as on one pair of wires.
TEST(NodesOnCan, TwoBoardsWithTheSameNodeBothReportNodeConflict) {
  CanRig twin;
  rig.start(master);
  twin.run(16.0);
  CHECK(rig.state() == State::active);
  const auto receive = rig.bus.listener;
  rig.bus.listener = [&](const hal::CanFrame& frame) {
    receive(frame);
    twin.bus.deliver(frame);
  };
  twin.bus.listener = [&](const hal::CanFrame& frame) { rig.bus.deliver(frame); };
  const auto together = [&](double time_s) {
    for (long i = std::lround(time_s * rig.settings.firmware.rate_Hz); i > 0; --i) {
      if (i % 50 == 0) rig.bus.deliver(master.frame(Verb::renew));
      rig.tick();
      twin.tick();
    }
  };
  together(0.25);
  CHECK(rig.fault() == Fault::node_conflict);
  CHECK(twin.fault() == Fault::node_conflict);
  CHECK(rig.loop.channel(1).state().first_cause() == Fault::node_conflict);
  DOUBLES_EQUAL(0.0, rig.true_power_W(), 0.0);
  CHECK(rig.loop.board_fault() == Fault::none);  // the heartbeat goes on
  CHECK(rig.command(master, Verb::reset) != Refusal::none);

  // The other one is taken off the bus.
  twin.bus.listener = [](const hal::CanFrame&) {};
  rig.bus.listener = receive;
  rig.run(3.0);
  rig.claim(master);
  CHECK(rig.command(master, Verb::reset) == Refusal::none);
  CHECK(rig.fault() == Fault::none);
}

TEST(NodesOnCan, ABoardDoesNotStartIfItsNodeIsAlreadyInUse) {
  hal::CanFrame heartbeat;
  heartbeat.id = SUPERCOIL_STATUS_FRAME_ID + 1;  // of its second channel
  heartbeat.length = SUPERCOIL_STATUS_LENGTH;
  for (int i = 0; i < 17; ++i) {
    rig.bus.deliver(heartbeat);
    rig.run(1.0);
  }
  CHECK(rig.fault() == Fault::node_conflict);
  CHECK_FALSE(rig.loop.self_test().passed());
  rig.claim(master);
  CHECK(rig.command(master, Verb::reset) == Refusal::cause_persists);
  CHECK(rig.command(master, Verb::arm) == Refusal::wrong_state);
}

/// Nothing on the bus shows that two sessions belong to one master.
TEST(NodesOnCan, EachNodeOfAJointHasItsOwnLease) {
  CanRig joint(joint_board());
  Master antagonist_master;
  antagonist_master.node = 2;
  Master stranger;
  stranger.node = 2;
  stranger.name = 0x4321;
  joint.run(16.0);
  const auto follow = [&] {
    CHECK(joint.command(master, Verb::position, 0.002F) == Refusal::none);
    joint.run(0.1);
    CHECK(joint.loop.channel(1).state().state() == State::active);
  };
  CHECK(joint.claim(master) == Refusal::none);
  CHECK(joint.command(master, Verb::arm) == Refusal::none);
  joint.run(0.2);
  follow();

  // A master that holds both nodes keeps others from both.
  CHECK(joint.claim(antagonist_master) == Refusal::none);
  CHECK(joint.claim(stranger) == Refusal::not_lease_holder);
  CHECK(joint.command(stranger, Verb::rest) == Refusal::not_lease_holder);
  follow();

  // One that holds only the agonist's does not; both muscles rest together.
  CHECK(joint.command(antagonist_master, telemetry::Opcode::lease, telemetry::release_value) ==
        Refusal::none);
  CHECK(joint.claim(stranger) == Refusal::none);
  follow();
  CHECK(joint.command(stranger, Verb::rest) == Refusal::none);
  for (const std::size_t channel : {0U, 1U})
    CHECK(joint.loop.channel(channel).state().state() == State::armed);
}

/// A listener to one node of a joint learns about the other muscle as well.
TEST(NodesOnCan, AgonistNodePublishesTheJointAndBothHeaters) {
  CanRig joint(joint_board());
  const auto seconds = [&](int count) {
    for (int i = 0; i < 10 * count; ++i) {
      CHECK(joint.command(master, Verb::position, -0.002F) == Refusal::none);
      joint.run(0.1);
    }
  };
  joint.run(16.0);
  joint.claim(master);
  joint.command(master, Verb::arm);
  joint.run(0.2);
  seconds(3);
  CHECK(joint.command(master, Verb::renew) == Refusal::none);
  joint.received_count.clear();
  std::array<supercoil_joint_t, telemetry::joint_parts(true)> parts{};
  const auto receive = joint.bus.listener;
  joint.bus.listener = [&](const hal::CanFrame& frame) {
    receive(frame);
    if (frame.id != SUPERCOIL_JOINT_FRAME_ID) return;
    const auto m = unpacked(frame, supercoil_joint_unpack);
    parts.at(m.part) = m;
  };
  joint.run(0.2);
  const Snapshot& agonist_now = joint.loop.channel(0).snapshot();
  const Snapshot& antagonist_now = joint.loop.channel(1).snapshot();
  DOUBLES_EQUAL(10, joint.received_count[SUPERCOIL_JOINT_FRAME_ID], 2);
  LONGS_EQUAL(0, joint.received_count[SUPERCOIL_JOINT_FRAME_ID + 1]);
  CHECK(agonist_now.mode == Mode::position && antagonist_now.mode == Mode::joint);

  constexpr double deg_per_m = 180.0 / 3.14159265358979 / 0.015;
  for (const supercoil_joint_t& part : parts) {
    DOUBLES_EQUAL(deg_per_m * agonist_now.position_m,
                  supercoil_joint_angle_deg_decode(part.angle_deg), 0.3);
  }
  DOUBLES_EQUAL(-0.002 * deg_per_m, supercoil_joint_reference_deg_decode(parts[0].reference_deg),
                0.001);
  DOUBLES_EQUAL(antagonist_now.demanded_W,
                supercoil_joint_co_contraction_w_decode(parts[1].co_contraction_w), 0.05);
  const auto is_of = [](const Snapshot& muscle, double hottest_C, double applied_W, double Ohm) {
    DOUBLES_EQUAL(muscle.hottest_C, hottest_C, 1.0);
    DOUBLES_EQUAL(muscle.applied_W, applied_W, 0.3);  // with the noise of the sensor
    DOUBLES_EQUAL(muscle.resistance_Ohm, Ohm, 0.1);
  };
  is_of(agonist_now, supercoil_joint_agonist_hottest_c_decode(parts[2].agonist_hottest_c),
        supercoil_joint_agonist_applied_w_decode(parts[3].agonist_applied_w),
        supercoil_joint_agonist_resistance_ohm_decode(parts[3].agonist_resistance_ohm));
  is_of(antagonist_now, supercoil_joint_antagonist_hottest_c_decode(parts[4].antagonist_hottest_c),
        supercoil_joint_antagonist_applied_w_decode(parts[5].antagonist_applied_w),
        supercoil_joint_antagonist_resistance_ohm_decode(parts[5].antagonist_resistance_ohm));
  CHECK(antagonist_now.hottest_C > agonist_now.hottest_C + 2.0);
}

TEST(NodesOnCan, NoJointFramesWithoutAJoint) {
  rig.run(1.0);
  LONGS_EQUAL(0, rig.received_count[SUPERCOIL_JOINT_FRAME_ID]);
  LONGS_EQUAL(0, rig.received_count[SUPERCOIL_JOINT_FRAME_ID + 1]);
}
