#include "loop/loop.hpp"

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(Loop) {
  RigSettings settings = rough_board();
};

TEST(Loop, GivesItsSelfTestTheTimeThatTheSlowestSenseNeeds) {
  const double decay_s = settings.firmware.supervision.charge_pump_decay_s;
  const auto duration_s = [&](double filter_s) {
    settings.firmware.channels[1].heater.sense_filter_s = filter_s;
    return Rig(settings).loop.self_test().duration_s();
  };
  // Five time constants to settle and eight of a pulse, three and two times; at least 50 and 30 ms.
  settings.firmware.channels[0].heater.sense_filter_s = 0.0;
  DOUBLES_EQUAL(decay_s + 3.0 * 0.05 + 2.0 * 0.03, duration_s(0.0), 1e-12);
  DOUBLES_EQUAL(decay_s + 3.0 * 0.05 + 2.0 * 0.04, duration_s(0.005), 1e-12);
  DOUBLES_EQUAL(decay_s + 3.0 * 0.1 + 2.0 * 0.16, duration_s(0.02), 1e-12);
}

TEST(Loop, FindsAnEnableLineThatDoesNotCutByAProbesCurrent) {
  for (const std::size_t broken : {0U, 1U}) {
    Rig rig(settings);
    rig.board.channel(broken).faults.enable_stuck_on = true;
    rig.run(1.0);
    CHECK(rig.loop.self_test().outcome() == SelfTest::Outcome::enable_does_not_cut);
    CHECK(rig.loop.board_fault() == Fault::self_test_failed);
  }
}

TEST(Loop, TakesAsManyCommandsAsItsRingHoldsAndNoMore) {
  Rig rig(settings);
  int taken = 0;
  while (rig.loop.send({Rig::tested, Verb::disarm}))
    ++taken;
  LONGS_EQUAL(256, taken);
}

/// Behind noise a probe's current could hide: nothing is proven.
TEST(Loop, DoesNotPassItsSelfTestWithASenseThatIsAllNoise) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RigSettings noisy = rough_board();
    noisy.board.seed = seed;
    noisy.board.channels.resize(1);
    noisy.firmware.channels.resize(1);
    noisy.board.channels[0].current.noise_rms = 0.08;
    host_sim::SimulatedBoard board(noisy.board);
    supercoil::Loop loop(noisy.firmware, board.devices());
    Executive executive(loop, board, noisy.firmware.rate_Hz);
    for (int i = 0; i < 1000; ++i)
      executive.run_tick();
    CHECK_FALSE(loop.self_test().passed());
  }
}
