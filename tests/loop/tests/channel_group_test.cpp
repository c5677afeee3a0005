// What the muscles of a joint or a bundle wait for, and what they leave when one of them fails.
#include <algorithm>

#include "loop/support/bundle_case.hpp"
#include "loop/support/joint_case.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP_BASE(BundleGroup, BundleCase){};

TEST(BundleGroup, HeatsOnlyAfterEveryMuscleWasProbed) {
  RigSettings settings = bundle_board();
  settings.firmware.channels[last].heater.probe_s = 0.5;
  Rig fresh(settings);
  fresh.boot();
  fresh.arm();
  fresh.run(0.2);
  CHECK(fresh.answer_of(leader, Verb::power, 1.0) == Refusal::busy);
  CHECK(fresh.state() == State::armed);
  fresh.run(0.4);
  CHECK(fresh.answer_of(leader, Verb::power, 1.0) == Refusal::none);
}

TEST(BundleGroup, CalibrateStopsAtAFailureOfTheLeader) {
  arm();
  rig.before_tick = [&] {
    host_sim::MuscleChannelSettings pulled = muscle_of(leader).settings();
    pulled.load_N = -0.05 * rig.time_s();
    muscle_of(leader).set(pulled);
  };
  CHECK(completes_mode(Verb::calibrate, 200.0));
  CHECK(of(leader).result == ModeResult::moved);
  for (const std::uint8_t i : {follower, last}) {
    CHECK(of(i).result == ModeResult::none);
    CHECK(of(i).mode == Mode::rest);
  }
  CHECK(all(State::armed));
}

TEST_GROUP_BASE(JointGroup, JointCase){};

/// The joint's limit does not apply to a muscle that is driven alone.
TEST(JointGroup, AMuscleDrivenAloneIgnoresTheCoContractionLimit) {
  RigSettings settings = joint_board();
  settings.firmware.joints[0].max_co_contraction_W = 0.8;
  Rig fresh(settings);
  begin(fresh);
  for (int i = 0; i < 10; ++i) {
    CHECK(fresh.answer_of(antagonist, Verb::power, 1.5) == Refusal::none);
    fresh.run(0.1);
  }
  DOUBLES_EQUAL(1.5, fresh.loop.channel(antagonist).snapshot().applied_W, 0.02);
}

TEST(JointGroup, CoContractionIsClippedToTheAntagonistsLimit) {
  constexpr double max_W = 0.4;
  RigSettings settings = joint_board();
  settings.firmware.joints[0].co_contraction_W = 1.0;
  settings.firmware.channels[antagonist].limiter.max_W = max_W;
  Rig fresh(settings);
  begin(fresh);
  CHECK_FALSE(faults_while_following(fresh, 0.1, [] { return 0.0; }));
  DOUBLES_EQUAL(max_W, fresh.loop.channel(antagonist).snapshot().reference, 1e-9);
}
