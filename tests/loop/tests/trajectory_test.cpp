// Trajectories over CAN, on a board of two channels.
#include <cmath>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "loop/support/can_rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr unsigned start_at_once = 0;
constexpr unsigned start_at_sync = 1;
constexpr unsigned query_only = 2;

hal::CanFrame knot_frame(Master& sender, double after_s, double position_m, double velocity = 0.0) {
  supercoil_knot_t m{};
  m.counter = sender.next_counter();
  m.after_s = static_cast<std::uint16_t>(std::lround(after_s * 1e3));
  m.position_m = static_cast<std::int32_t>(std::lround(position_m * 1e7));
  m.velocity_m_per_s = static_cast<std::int16_t>(std::lround(velocity * 1e5));
  hal::CanFrame frame =
      packed(SUPERCOIL_KNOT_FRAME_ID, SUPERCOIL_KNOT_LENGTH, sender.node, m, supercoil_knot_pack);
  can::e2e::protect(frame, sender.session);
  return frame;
}

hal::CanFrame play_frame(Master& sender, unsigned when, std::uint8_t sync, double after_s) {
  supercoil_play_t m{};
  m.counter = sender.next_counter();
  m.when = static_cast<std::uint8_t>(when);
  m.session = sender.session;
  m.sync = sync;
  m.after_s = static_cast<std::uint32_t>(std::lround(after_s * 1e5));
  return sealed(SUPERCOIL_PLAY_FRAME_ID, SUPERCOIL_PLAY_LENGTH, sender.node, m,
                supercoil_play_pack);
}

hal::CanFrame sync_frame(std::uint8_t number, double master_s) {
  supercoil_sync_t m{};
  m.sync = number;
  m.master_time_s = static_cast<std::uint64_t>(std::llround(master_s * 1e6));
  return sealed(SUPERCOIL_SYNC_FRAME_ID, SUPERCOIL_SYNC_LENGTH, 1, m, supercoil_sync_pack);
}

}  // namespace

TEST_GROUP(TrajectoryOverCan) {
  CanRig rig;
  Master master;
  Master second;

  void setup() override {
    second.node = 2;
    second.name = 0x2222;
    rig.run(16.0);
    for (Master* sender : {&master, &second}) {
      rig.claim(*sender);
      rig.command(*sender, Verb::arm);
      rig.run(0.2);
    }
    hold(0.005, 12.0);
  }
  /// Both at a position, renewed.
  void hold(double position_m, double time_s) {
    for (Master* sender : {&master, &second})
      rig.command(*sender, Verb::position, static_cast<float>(position_m));
    renew(time_s);
  }
  void renew(double time_s) {
    for (long i = std::lround(time_s / 0.1); i > 0; --i) {
      for (Master* sender : {&master, &second})
        rig.bus.deliver(sender->frame(Verb::renew));
      rig.run(0.1);
    }
  }
  /// The newest frame of a node; answers: only frames that answer something.
  supercoil_trajectory_t newest_state(const Master& sender, bool answers = false) const {
    supercoil_trajectory_t newest{};
    for (const hal::CanFrame& frame : rig.trajectories) {
      if (frame.id != SUPERCOIL_TRAJECTORY_FRAME_ID + sender.node - 1) continue;
      supercoil_trajectory_t m{};
      supercoil_trajectory_unpack(&m, frame.data.data(), frame.length);
      CHECK(can::e2e::intact(frame, SUPERCOIL_TRAJECTORY_LENGTH));
      if (!answers || m.answers != 0) newest = m;
    }
    return newest;
  }
  /// no_such_channel: no answer.
  Refusal answer_to(Master & sender, const hal::CanFrame& frame) {
    rig.trajectories.clear();
    rig.bus.deliver(frame);
    for (int i = 0; i < 20 && newest_state(sender, true).answers == 0; ++i)
      rig.tick();
    const auto answer = newest_state(sender, true);
    if (answer.answers == 0) return Refusal::no_such_channel;
    LONGS_EQUAL(frame.data[1] & 15, answer.counter);
    return static_cast<Refusal>(answer.refusal);
  }
  Refusal knot(Master & sender, double after_s, double position_m, double velocity = 0.0) {
    return answer_to(sender, knot_frame(sender, after_s, position_m, velocity));
  }
  void load(Master & sender, double from_m = 0.005, double to_m = 0.006) {
    CHECK(knot(sender, 0.0, from_m) == Refusal::none);
    CHECK(knot(sender, 2.0, to_m) == Refusal::none);
  }
  PlaybackState state(std::size_t channel = 0) const {
    return rig.loop.channel(channel).playback().state;
  }
  double reference_m(std::size_t channel = 0) const {
    return rig.loop.channel(channel).snapshot().reference;
  }
};

TEST(TrajectoryOverCan, IsPlayedFollowedAndHeldAtItsEnd) {
  load(master);
  LONGS_EQUAL(1, newest_state(master).playback);
  LONGS_EQUAL(62, newest_state(master).room);
  CHECK(answer_to(master, play_frame(master, start_at_once, 0, 0.05)) == Refusal::none);
  LONGS_EQUAL(2, newest_state(master).playback);
  renew(1.0);
  CHECK(state() == PlaybackState::playing);
  LONGS_EQUAL(3, newest_state(master).playback);
  renew(6.0);
  CHECK(state() == PlaybackState::ended);
  LONGS_EQUAL(4, newest_state(master).playback);
  DOUBLES_EQUAL(0.006, reference_m(), 1e-7);
  DOUBLES_EQUAL(0.006, rig.loop.channel(0).snapshot().position_m, 0.0003);
  CHECK(answer_to(master, play_frame(master, query_only, 0, 0.0)) == Refusal::none);
  LONGS_EQUAL(4, newest_state(master).playback);
  // The neighbour got nothing.
  CHECK(state(1) == PlaybackState::empty);
}

// However slow a reference model is: that of PI needs 4 s for a step.
TEST(TrajectoryOverCan, ReferenceModelFollowsTheKnots) {
  CHECK(knot(master, 0.0, 0.005) == Refusal::none);
  CHECK(knot(master, 1.0, 0.0055, 0.001) == Refusal::none);
  CHECK(knot(master, 1.0, 0.006) == Refusal::none);
  CHECK(knot(master, 1.0, 0.0055) == Refusal::none);
  CHECK(answer_to(master, play_frame(master, start_at_once, 0, 0.05)) == Refusal::none);
  renew(0.1);
  CHECK(state() == PlaybackState::playing);
  while (state() == PlaybackState::playing) {
    const Snapshot& now = rig.loop.channel(0).snapshot();
    DOUBLES_EQUAL(now.reference, now.model_m, 15e-6);
    renew(0.1);
  }
  CHECK(state() == PlaybackState::ended);
  DOUBLES_EQUAL(reference_m(), rig.loop.channel(0).snapshot().model_m, 15e-6);
}

TEST(TrajectoryOverCan, TwoChannelsStartInTheSameTickAfterASync) {
  load(master);
  load(second, 0.005, 0.0055);
  for (Master* sender : {&master, &second})
    CHECK(answer_to(*sender, play_frame(*sender, start_at_sync, 7, 0.03)) == Refusal::none);
  rig.bus.deliver(sync_frame(6, 50.0));
  renew(0.2);
  CHECK(state() == PlaybackState::loaded && state(1) == PlaybackState::loaded);
  rig.bus.deliver(sync_frame(7, 50.2));
  for (int i = 0; i < 100 && state() != PlaybackState::playing; ++i) {
    CHECK(state() == state(1));
    rig.tick();
  }
  CHECK(state() == PlaybackState::playing && state(1) == PlaybackState::playing);
  renew(1.0);
  // Each has covered the same fraction of its way.
  DOUBLES_EQUAL((reference_m() - 0.005) / 0.001, (reference_m(1) - 0.005) / 0.0005, 1e-6);
}

TEST(TrajectoryOverCan, StartsByAnEarlierSync) {
  load(master);
  rig.bus.deliver(sync_frame(200, 50.0));
  renew(0.1);
  CHECK(answer_to(master, play_frame(master, start_at_sync, 200, 0.5)) == Refusal::none);
  CHECK(state() == PlaybackState::waiting);
}

TEST(TrajectoryOverCan, AStaleSyncDoesNotStartPlayback) {
  load(master);
  load(second);
  rig.bus.deliver(sync_frame(200, 50.0));
  renew(0.5);
  // According to that sync its start would be over.
  CHECK(answer_to(master, play_frame(master, start_at_sync, 200, 0.3)) == Refusal::none);
  renew(2.0);
  // And according to that sync this one would start soon.
  CHECK(answer_to(second, play_frame(second, start_at_sync, 200, 5.0)) == Refusal::none);
  renew(0.5);
  CHECK(state() == PlaybackState::loaded && state(1) == PlaybackState::loaded);
  rig.bus.deliver(sync_frame(200, 70.0));
  renew(0.5);
  CHECK(state() == PlaybackState::playing && state(1) == PlaybackState::waiting);
  renew(4.0);
  CHECK(state(1) == PlaybackState::waiting);
  renew(1.0);
  CHECK(state(1) == PlaybackState::playing);
}

TEST(TrajectoryOverCan, ANewPlayReplacesAWaitingOne) {
  load(master);
  CHECK(answer_to(master, play_frame(master, start_at_sync, 9, 0.05)) == Refusal::none);
  CHECK(answer_to(master, play_frame(master, start_at_once, 0, 0.05)) == Refusal::none);
  renew(0.5);
  CHECK(state() == PlaybackState::playing);
  rig.trajectories.clear();
  rig.bus.deliver(sync_frame(9, 50.0));
  renew(0.3);
  CHECK_EQUAL(0, newest_state(master, true).answers);
  CHECK(state() == PlaybackState::playing);
}

TEST(TrajectoryOverCan, FollowsTheMastersClock) {
  constexpr double velocity = 0.0002;
  CHECK(knot(master, 0.0, 0.005) == Refusal::none);
  CHECK(knot(master, 2.0, 0.0052, velocity) == Refusal::none);
  for (const double position_m : {0.006, 0.0068, 0.0076, 0.0084})
    CHECK(knot(master, 4.0, position_m, velocity) == Refusal::none);
  CHECK(answer_to(master, play_frame(master, start_at_sync, 1, 0.05)) == Refusal::none);
  const hal::Time synced = rig.board.now();
  rig.bus.deliver(sync_frame(1, 50.0));
  // It goes steadily from the third knot on.
  renew(6.5);
  const double first_m = reference_m();
  // The master's clock is 8 ms ahead by now.
  const double elapsed_s = hal::seconds(rig.board.now() - synced);
  rig.bus.deliver(sync_frame(2, 50.0 + elapsed_s + 0.008));
  renew(9.0);
  DOUBLES_EQUAL(9.0 + 0.008, (reference_m() - first_m) / velocity, 0.0002);
}

TEST(TrajectoryOverCan, PlaybackStopsWhenTheMasterFallsSilent) {
  load(master);
  CHECK(answer_to(master, play_frame(master, start_at_once, 0, 0.0)) == Refusal::out_of_range);
  CHECK(answer_to(master, play_frame(master, start_at_once, 0, 0.02)) == Refusal::none);
  rig.run(0.5);
  CHECK(rig.fault() == Fault::command_timeout);
  DOUBLES_EQUAL(0.0, rig.true_power_W(), 0.0);
  CHECK(state() == PlaybackState::empty);
}

TEST(TrajectoryOverCan, KnotsRenewThePlaybackAndItRestsASecondAfterTheLastKnot) {
  CHECK(knot(master, 0.0, 0.005) == Refusal::none);
  double position_m = 0.005;
  for (int i = 0; i < 3; ++i)
    CHECK(knot(master, 0.2, position_m += 0.0001, 0.0005) == Refusal::none);
  CHECK(answer_to(master, play_frame(master, start_at_once, 0, 0.02)) == Refusal::none);
  for (int i = 0; i < 10; ++i) {
    rig.run(0.18);
    CHECK(knot(master, 0.2, position_m += 0.0001, 0.0005) == Refusal::none);
  }
  CHECK(rig.state() == State::active);
  renew(1.0);
  CHECK(state() == PlaybackState::dry);
  LONGS_EQUAL(5, newest_state(master).playback);
  CHECK(rig.state() == State::active);
  for (int i = 0; i < 20 && rig.state() == State::active; ++i) {
    rig.bus.deliver(master.frame(Verb::renew));
    rig.run(0.1);
  }
  CHECK(rig.state() == State::armed);
  CHECK(rig.fault() == Fault::none);
  CHECK(state() == PlaybackState::empty);
}

TEST(TrajectoryOverCan, AnotherCommandDiscardsIt) {
  load(master);
  CHECK(answer_to(master, play_frame(master, start_at_once, 0, 0.02)) == Refusal::none);
  renew(0.5);
  CHECK(rig.command(master, Verb::position, 0.0052F) == Refusal::none);
  rig.tick();
  CHECK(state() == PlaybackState::empty);
  DOUBLES_EQUAL(0.0052, reference_m(), 1e-8);
  renew(12.0);
  DOUBLES_EQUAL(0.0052, rig.loop.channel(0).snapshot().model_m, 2e-5);
  CHECK(answer_to(second, play_frame(second, query_only, 0, 0.0)) == Refusal::none);
  load(second);
  CHECK(rig.command(second, Verb::rest) == Refusal::none);
  CHECK(state(1) == PlaybackState::empty);
  CHECK(knot(second, 0.0, 0.005) == Refusal::wrong_state);
}

TEST(TrajectoryOverCan, NeedsTheLeaseTheSessionAndTheCounter) {
  const hal::CanFrame first = knot_frame(master, 0.0, 0.005);
  CHECK(answer_to(master, first) == Refusal::none);
  CHECK(answer_to(master, first) == Refusal::wrong_counter);
  Master other = master;
  other.session = static_cast<std::uint16_t>(master.session + 1);
  // Its session enters the checksum alone, so to the board the frame is damaged.
  CHECK(answer_to(other, knot_frame(other, 1.0, 0.005)) == Refusal::no_such_channel);
  CHECK(answer_to(other, play_frame(other, start_at_once, 0, 0.1)) == Refusal::not_lease_holder);
  CHECK(rig.command(master, telemetry::Opcode::lease, telemetry::release_value) == Refusal::none);
  CHECK(answer_to(master, knot_frame(master, 1.0, 0.005)) == Refusal::no_lease);
}

TEST(TrajectoryOverCan, KnotsOfAReplacedMasterAreHarmless) {
  load(master);
  Master replaced = master;
  CHECK(rig.command(master, telemetry::Opcode::lease, telemetry::release_value) == Refusal::none);
  master.name = 0x3333;
  CHECK(rig.claim(master) == Refusal::none);
  CHECK(rig.claim(master) == Refusal::none);  // as if the first answer had been lost
  CHECK(rig.command(master, Verb::position, 0.005F) == Refusal::none);
  // The replaced one does not know it yet.
  for (int i = 0; i < 20; ++i) {
    rig.bus.deliver(knot_frame(replaced, 1.0, 0.005));
    rig.tick();
  }
  CHECK(rig.fault() == Fault::none);
  CHECK(knot(replaced, 0.0, 0.005) == Refusal::not_lease_holder);
  CHECK(state() == PlaybackState::empty);
  load(master);
}

TEST(TrajectoryOverCan, DamagedFramesAreIgnored) {
  load(master);
  const hal::CanFrame good = knot_frame(master, 1.0, 0.005);
  for (unsigned bit = 0; bit < 64; ++bit) {
    hal::CanFrame frame = good;
    frame.data[bit / 8] = static_cast<std::uint8_t>(frame.data[bit / 8] ^ (1U << bit % 8));
    rig.bus.deliver(frame);
    rig.tick();
    LONGS_EQUAL(62, rig.loop.channel(0).playback().room);
    // Some in a row would be a fault.
    if (bit % 4 == 3) CHECK(rig.command(master, Verb::renew) == Refusal::none);
  }
  for (std::uint8_t length = 0; length < 8; ++length) {
    hal::CanFrame frame = good;
    frame.length = length;
    rig.bus.deliver(frame);
    rig.tick();
    CHECK(rig.command(master, Verb::renew) == Refusal::none);
  }
  LONGS_EQUAL(62, rig.loop.channel(0).playback().room);
  CHECK(rig.fault() == Fault::none);
}

TEST(TrajectoryOverCan, SyncAloneMovesNothing) {
  for (int i = 0; i < 300; ++i)
    rig.bus.deliver(sync_frame(static_cast<std::uint8_t>(i), 1e6 * (i % 7)));
  renew(0.5);
  CHECK(rig.state() == State::active);
  CHECK(state() == PlaybackState::empty);
  // A clock that jumps is not followed.
  load(master);
  CHECK(answer_to(master, play_frame(master, start_at_sync, 44, 0.02)) == Refusal::none);
  rig.bus.deliver(sync_frame(44, 50.0));
  renew(0.3);
  rig.bus.deliver(sync_frame(45, 90.0));
  const double before_m = reference_m();
  renew(0.1);
  CHECK(reference_m() - before_m < 0.0002);
}

TEST(TrajectoryOverCan, SyncDoesNotCountAsACommand) {
  load(master);
  CHECK(answer_to(master, play_frame(master, start_at_sync, 1, 0.02)) == Refusal::none);
  rig.bus.deliver(sync_frame(1, 50.0));
  renew(0.1);
  CHECK(state() == PlaybackState::playing);
  // However many arrive, a command finds room.
  for (int i = 0; i < 600; ++i)
    rig.bus.deliver(sync_frame(1, 50.0));
  CHECK(rig.command(second, Verb::disarm) == Refusal::none);
  // They do not interrupt a row of damaged commands.
  renew(0.1);
  for (int i = 0; i < 12; ++i) {
    hal::CanFrame damaged = master.frame(Verb::renew);
    damaged.data[4] ^= 1U;
    rig.bus.deliver(damaged);
    rig.tick();
    rig.bus.deliver(sync_frame(1, 50.0));
    rig.tick();
  }
  CHECK(rig.fault() == Fault::command_damaged);
}

TEST(TrajectoryOverCan, AStartDoesNotRenewTheCommand) {
  load(master);
  CHECK(answer_to(master, play_frame(master, start_at_sync, 1, 0.02)) == Refusal::none);
  CHECK(rig.command(master, Verb::renew) == Refusal::none);
  rig.run(0.2);
  // The master is dead by now, and another program sends the time.
  rig.bus.deliver(sync_frame(1, 50.0));
  rig.run(0.1);
  CHECK(rig.fault() == Fault::command_timeout);
}

TEST(TrajectoryOverCan, AWaitingStartDoesNotApplyToTheNextTrajectory) {
  load(master);
  CHECK(answer_to(master, play_frame(master, start_at_sync, 1, 0.02)) == Refusal::none);
  CHECK(rig.command(master, Verb::position, 0.005F) == Refusal::none);
  load(master);
  rig.bus.deliver(sync_frame(1, 50.0));
  renew(0.2);
  CHECK(state() == PlaybackState::loaded);
}
