#include "loop/loop.hpp"

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(Loop) {
  RigSettings settings = rough_board();
};

TEST(Loop, SelfTestDurationFollowsTheSlowestSense) {
  const double decay_s = settings.firmware.supervision.charge_pump_decay_s;
  const auto duration_s = [&](double filter_s) {
    settings.firmware.channels[1].heater.sense_filter_s = filter_s;
    return Rig(settings).loop.self_test().duration_s();
  };
  // Settling three times takes 5 time constants each, at least 50 ms; two pulses 8, at least 30 ms.
  settings.firmware.channels[0].heater.sense_filter_s = 0.0;
  DOUBLES_EQUAL(decay_s + 3.0 * 0.05 + 2.0 * 0.03, duration_s(0.0), 1e-12);
  DOUBLES_EQUAL(decay_s + 3.0 * 0.05 + 2.0 * 0.04, duration_s(0.005), 1e-12);
  DOUBLES_EQUAL(decay_s + 3.0 * 0.1 + 2.0 * 0.16, duration_s(0.02), 1e-12);
}

TEST(Loop, SelfTestFindsAnEnableLineThatDoesNotCut) {
  for (const std::size_t broken : {0U, 1U}) {
    Rig rig(settings);
    rig.board.channel(broken).faults.enable_stuck_on = true;
    rig.run(1.0);
    CHECK(rig.loop.self_test().outcome() == SelfTest::Outcome::enable_does_not_cut);
    CHECK(rig.loop.board_fault() == Fault::self_test_failed);
  }
}

TEST(Loop, ReportsWhichCutOffFailedTheSelfTest) {
  for (const bool pump_stuck : {true, false}) {
    Rig rig(settings);
    rig.board.pump.stuck_closed = pump_stuck;
    rig.muscle().faults.enable_stuck_on = !pump_stuck;
    rig.run(1.0);
    CHECK(rig.fault() == Fault::self_test_failed);
    DOUBLES_EQUAL(pump_stuck ? 1.0 : 2.0, rig.loop.channel(Rig::tested).first_margin().measured,
                  0.0);
  }
}

TEST(Loop, CommandRingHolds256) {
  Rig rig(settings);
  int taken = 0;
  while (rig.loop.send({Rig::tested, Verb::disarm}))
    ++taken;
  LONGS_EQUAL(256, taken);
}

TEST(Loop, SelfTestFindsALeakageCurrent) {
  constexpr double leak_A = 0.006;  // less than half of a probe's current
  for (const double off_current_A : {0.05, 0.003}) {
    RigSettings leaking = rough_board();
    leaking.firmware.channels[1].supervision.off_current_A = off_current_A;
    Rig rig(leaking);
    rig.board.channel(1).current.set({.offset = leak_A});
    rig.run(1.0);
    CHECK_EQUAL(off_current_A > leak_A, rig.loop.self_test().passed());
  }
}

/// Noise could hide a probe's current, so nothing would be proven.
TEST(Loop, SelfTestFailsWithASenseThatIsAllNoise) {
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

TEST(Loop, FeedsTheWatchdogOncePerTickEvenInAFault) {
  Rig rig(settings);
  const auto feeds_in = [&](int ticks) {
    const std::int64_t before = rig.board.watchdog.fed;
    rig.run_ticks(ticks);
    return static_cast<long>(rig.board.watchdog.fed - before);
  };
  LONGS_EQUAL(100, feeds_in(100));
  rig.boot();
  rig.board.stop_circuit.level.high = false;
  LONGS_EQUAL(100, feeds_in(100));
  CHECK(rig.loop.board_fault() == Fault::emergency_stop);
}

TEST(Loop, NeedsNeitherAWatchdogNorALight) {
  host_sim::SimulatedBoard board(settings.board);
  board::Devices devices = board.devices();
  devices.watchdog = nullptr;
  devices.light = nullptr;
  supercoil::Loop loop(settings.firmware, devices);
  Executive executive(loop, board, settings.firmware.rate_Hz);
  for (int i = 0; i < 1000; ++i)
    executive.run_tick();
  CHECK(loop.self_test().passed());
  LONGS_EQUAL(0, board.watchdog.fed);
  UNSIGNED_LONGS_EQUAL(0, board.light.edges());
}

/// The loop never answers such a command, so nothing may wait for the answer.
TEST(Loop, ACommandThatDoesNotFitDoesNotBlockTheTuner) {
  Rig rig(settings);
  while (rig.loop.send({Rig::tested, Verb::disarm}))
    continue;
  CHECK_FALSE(rig.loop.send({Rig::tested, Verb::store, store_tuning}));
  rig.run_ticks(10);
  CHECK(rig.answer_to(Verb::store, store_tuning) == Refusal::none);
}

TEST(Loop, AnswersCarryTheOriginalCommand) {
  Rig rig(settings);
  const Command given{Rig::neighbour, Verb::position, 0.0125, Source::can, 4711};
  CHECK(rig.loop.send(given));
  rig.executive.run_tick();
  Answer answer;
  CHECK(rig.loop.answer(answer));
  LONGS_EQUAL(Rig::neighbour, answer.command.channel);
  CHECK(answer.command.verb == Verb::position && answer.command.source == Source::can);
  DOUBLES_EQUAL(0.0125, answer.command.value, 0.0);
  UNSIGNED_LONGS_EQUAL(4711, answer.command.id);
  CHECK(answer.refusal == Refusal::wrong_state);
  CHECK_FALSE(rig.loop.answer(answer));
}

/// So that a flood of them makes no tick late; the rest waits.
TEST(Loop, HandlesUpTo64CommandsPerTick) {
  Rig rig(settings);
  for (int i = 0; i < 100; ++i)
    CHECK(rig.loop.send({Rig::tested, Verb::disarm}));
  const auto answers_of_a_tick = [&rig] {
    rig.executive.run_tick();
    int answers = 0;
    for (Answer answer; rig.loop.answer(answer);)
      ++answers;
    return answers;
  };
  LONGS_EQUAL(64, answers_of_a_tick());
  LONGS_EQUAL(36, answers_of_a_tick());
}

/// Converters have their first values by then.
TEST(Loop, StartsJudgingTheBoardAfter100Milliseconds) {
  settings.board.supply_V = 10.0;
  Rig rig(settings);
  rig.run_ticks(100);
  CHECK(rig.loop.board_fault() == Fault::none);
  rig.run_ticks(1);
  CHECK(rig.loop.board_fault() == Fault::under_voltage);
}

/// The largest of each kind until it is taken.
TEST(Loop, ReportsWakeUpLatenessAndExecutionTime) {
  Rig rig(settings);
  CHECK(rig.loop.timing().late_ns == LoopTiming::none);
  CHECK(rig.loop.timing().execution_ns == LoopTiming::none);
  rig.run_ticks(10);
  LONGS_EQUAL(0, rig.loop.timing().late_ns);
  LONGS_EQUAL(0, rig.loop.timing().execution_ns);
  rig.board.oversleep(0.2e-3);
  rig.board.lose_in_tick(0.3e-3);
  rig.run_ticks(1);
  DOUBLES_EQUAL(0.2e-3, hal::seconds(rig.loop.last_tick().late), 1e-6);
  DOUBLES_EQUAL(0.3e-3, hal::seconds(rig.loop.last_tick().execution), 1e-6);
  rig.run_ticks(10);
  LONGS_EQUAL(0, rig.loop.last_tick().late.count());
  DOUBLES_EQUAL(0.2e6, static_cast<double>(rig.loop.timing().late_ns), 1e3);
  DOUBLES_EQUAL(0.3e6, static_cast<double>(rig.loop.timing().execution_ns), 1e3);
  LONGS_EQUAL(0, rig.loop.overruns());
  UNSIGNED_LONGS_EQUAL(0, rig.loop.timing().overruns);
}

/// The thermal model takes a step for each period left out, up to a max number.
TEST(Loop, SurvivesAStallOfAnyLength) {
  Rig rig(settings);
  rig.boot();
  const hal::Time now = rig.board.now();
  rig.loop.tick(now, now, std::int64_t{1} << 40);
  CHECK(rig.fault() == Fault::overrun);
  CHECK_COMPARE(rig.snapshot().hottest_C, <, 200.0);
}

TEST(Loop, CountsLostRows) {
  host_sim::SimulatedBoard board(settings.board);
  supercoil::Loop loop(settings.firmware, board.devices());
  Executive executive(loop, board, settings.firmware.rate_Hz);
  // One row per tick from each of two channels, and room for a second.
  for (int i = 0; i < 1000; ++i)
    executive.run_tick();
  UNSIGNED_LONGS_EQUAL(0, loop.timing().lost_rows);
  executive.run_tick();
  executive.run_tick();
  UNSIGNED_LONGS_EQUAL(4, loop.timing().lost_rows);
  Row row;
  for (int i = 0; i < 4; ++i)
    CHECK(loop.take(row));
  executive.run_tick();
  UNSIGNED_LONGS_EQUAL(4, loop.timing().lost_rows);
}
