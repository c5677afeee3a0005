// Who speaks and holds the lease of which node, where a bus or a joint has several.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "loop/support/can_rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(NodesOnCan) {
  CanRig rig;
  Master master;
};

/// Each hears what the other sends, as on one pair of wires.
TEST(NodesOnCan, TwoBoardsWithOneNodeBothGoColdAndNameIt) {
  CanRig twin;
  rig.start(master);
  twin.run(16.0);
  CHECK(rig.state() == State::active);
  const auto hear = rig.bus.listener;
  rig.bus.listener = [&](const hal::CanFrame& frame) {
    hear(frame);
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
  rig.bus.listener = hear;
  rig.run(3.0);
  rig.claim(master);
  CHECK(rig.command(master, Verb::reset) == Refusal::none);
  CHECK(rig.fault() == Fault::none);
}

TEST(NodesOnCan, ABoardDoesNotStartWhereItsNodeSpeaksAlready) {
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

/// Nothing on the bus tells that two sessions are of one master.
TEST(NodesOnCan, EachNodeOfAJointHasALeaseOfItsOwn) {
  CanRig joint(joint_board());
  Master antagonist;
  antagonist.node = 2;
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

  // Who holds both nodes keeps others from both.
  CHECK(joint.claim(antagonist) == Refusal::none);
  CHECK(joint.claim(stranger) == Refusal::not_lease_holder);
  CHECK(joint.command(stranger, Verb::rest) == Refusal::not_lease_holder);
  follow();

  // Who holds the agonist's alone does not; both muscles rest together.
  CHECK(joint.command(antagonist, telemetry::Opcode::lease, telemetry::releases) == Refusal::none);
  CHECK(joint.claim(stranger) == Refusal::none);
  follow();
  CHECK(joint.command(stranger, Verb::rest) == Refusal::none);
  for (const std::size_t channel : {0U, 1U})
    CHECK(joint.loop.channel(channel).state().state() == State::armed);
}
