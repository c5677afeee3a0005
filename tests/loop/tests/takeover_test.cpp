// Switching controllers while hot.
#include <cmath>
#include <functional>

#include <CppUTest/TestHarness.h>

#include "loop/support/situations.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr double noise_rms_m = 10e-6;
constexpr int warm_ticks = 40'000;

/// Two identical rigs, until one of them gets a different command.
struct Twins {
  explicit Twins(const RigSettings& settings) : stays(settings), switches(settings) {}

  template <typename What>
  void both(What what) {
    what(stays);
    what(switches);
  }
  void warm_up(Task task, int controller) {
    both([&](Rig& rig) {
      rig.boot();
      rig.arm();
      rig.run(0.2);
      rig.send(Verb::controller, controller);
      rig.heat(task);
    });
  }
  /// How far apart they get; `ask` is called every tick.
  double apart_m(int ticks, const std::function<void(Rig&)>& ask) {
    double furthest_m = 0.0;
    for (int i = 0; i < ticks; ++i) {
      both([&](Rig& rig) {
        ask(rig);
        rig.tick();
      });
      furthest_m = std::fmax(furthest_m, std::abs(switches.muscle().plant().position_m() -
                                                  stays.muscle().plant().position_m()));
    }
    CHECK(switches.state() == State::active);
    return furthest_m;
  }

  Rig stays;
  Rig switches;
};

void follow(Rig&) {}
void hold(Rig& rig) {
  rig.send(Verb::position, 0.010);
}

/// Moves the muscle so that an estimator can learn all of it.
void excite(Rig& rig) {
  const double time_s = rig.time_s();
  rig.send(Verb::power, 2.2 + 0.5 * (std::sin(0.3 * time_s) + std::sin(1.1 * time_s)) +
                            0.5 * (std::sin(3.1 * time_s) + std::sin(9.0 * time_s)));
}

/// How far the muscle is, within a time after a switch, from where it would be without the switch.
double moved_m(int from, int to, bool moving, int ticks) {
  Twins twins(rough_board());
  twins.warm_up(Task::position, from);
  if (!moving) twins.both([](Rig& rig) { rig.task = Task::nothing; });
  twins.apart_m(warm_ticks, moving ? follow : hold);
  twins.switches.send(Verb::controller, to);
  return twins.apart_m(ticks, moving ? follow : hold);
}

/// The value published next, within a second.
double proportional_W_per_m(Rig& rig) {
  const control::GainValue& published = rig.snapshot().gain;
  for (int i = 0; i < 1000 && published.gain != control::Gain::proportional; ++i) {
    hold(rig);
    rig.tick();
  }
  CHECK(published.gain == control::Gain::proportional);
  return published.value;
}

}  // namespace

TEST_GROUP(Takeover){};

TEST(Takeover, AtRestMovesTheMuscleByLessThanTheNoise) {
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) {
      const double moved = moved_m(from, to, false, 1000);
      if (from != to) printf("%d -> %d at rest: %.2f um\n", from, to, moved * 1e6);
      CHECK_COMPARE(moved, <, noise_rms_m);
    }
  }
}

/// Later it goes where the other controller leads it: their errors in motion differ by 200 µm.
TEST(Takeover, InMotionDoesNotJerkTheMuscle) {
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) {
      const double moved = moved_m(from, to, true, 100);
      if (from != to) printf("%d -> %d in motion: %.2f um\n", from, to, moved * 1e6);
      CHECK_COMPARE(moved, <, noise_rms_m);
    }
  }
}

/// Following a position begins with the power that was given before.
TEST(Takeover, FromOpenLoopDoesNotJerkTheMuscle) {
  for (int to = 0; to < 3; ++to) {
    Twins twins(rough_board());
    twins.warm_up(Task::power, to);
    twins.both([](Rig& rig) { rig.task = Task::nothing; });
    twins.apart_m(warm_ticks, [](Rig& rig) { rig.send(Verb::power, 1.8); });
    const double here_m = twins.switches.snapshot().position_m;
    const double moved = twins.apart_m(100, [&](Rig& rig) {
      const bool follows = &rig == &twins.switches;
      follows ? rig.send(Verb::position, here_m) : rig.send(Verb::power, 1.8);
    });
    printf("power -> %d: %.2f um\n", to, moved * 1e6);
    CHECK_COMPARE(moved, <, noise_rms_m);
  }
}

/// Gains derived from the muscle use the one that is known when the controller starts.
TEST(Takeover, StoredMuscleTakesEffectAtTheNextStart) {
  RigSettings settings = rough_board();
  ChannelSettings& channel = settings.firmware.channels[Rig::tested];
  channel.controllers.resize(1);
  channel.controllers[0].kind = control::ControllerKind::adaptive_ff;
  channel.estimators[0] = {};
  channel.estimators[0].kind = control::EstimatorKind::least_squares;
  channel.supervision.proof_of_response = false;  // only known muscles must prove it
  settings.board.channels[Rig::tested].plant.stiffness_N_per_m = 14.0;
  Twins twins(settings);
  twins.warm_up(Task::power, 0);
  twins.both([](Rig& rig) { rig.task = Task::nothing; });
  twins.apart_m(warm_ticks, excite);
  twins.apart_m(1000, hold);
  CHECK_TRUE(twins.switches.snapshot().trusted);
  // Always on both: reading takes ticks, and the twins must stay alike.
  const double before = proportional_W_per_m(twins.switches);
  proportional_W_per_m(twins.stays);

  twins.switches.send(Verb::store, 1.0);
  DOUBLES_EQUAL(0.0, twins.apart_m(2000, hold), 0.0);
  board::LearnedUpdate update;
  CHECK_TRUE(twins.switches.loop.channel(Rig::tested).take_learned_update(update));
  DOUBLES_EQUAL(14.0, update->muscle.stiffness_N_per_m, 0.5);
  DOUBLES_EQUAL(before, proportional_W_per_m(twins.switches), 0.0);
  proportional_W_per_m(twins.stays);

  twins.both([](Rig& rig) {
    rig.send(Verb::rest);
    rig.run(0.1);
    CHECK(rig.state() == State::armed);
    rig.heat(Task::position);
    rig.task = Task::nothing;
  });
  DOUBLES_EQUAL(before, proportional_W_per_m(twins.stays), 0.0);
  DOUBLES_EQUAL(before * 14.0 / 16.0, proportional_W_per_m(twins.switches), 0.1 * before);
  CHECK(proportional_W_per_m(twins.switches) < 0.98 * before);
}
