// A muscle whose motion no longer reaches the sensor, and whose cooling is worse from then on.
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <CppUTest/TestHarness.h>

#include "loop/row.hpp"
#include "loop/support/rig.hpp"

using namespace supercoil;
using test::Rig;

namespace {

/// Resistance does not tell temperature: only the position can show that something is wrong.
test::RigSettings constant_resistance_board(bool identified) {
  test::RigSettings s = test::rough_board();
  s.firmware.channels[Rig::tested].heater.temperature_coefficient_per_K = 0.0;
  s.board.channels[Rig::tested].temperature_coefficient_per_K = 0.0;
  s.firmware.channels[Rig::tested].muscle_identified = identified;
  s.firmware.channels[Rig::tested].senses.error_ratio = 0.02;  // compared with a meter
  s.firmware.channels[Rig::tested].supervision.energy_J = 1e6;
  // With an identified muscle only the proof is tested, not the window.
  if (identified) s.firmware.channels[Rig::tested].supervision.responding_window_s = 600.0;
  return s;
}

class LostContact {
 public:
  explicit LostContact(const test::RigSettings& settings) : settings_(settings), rig(settings) {
    rig.boot();
  }

  /// Commands `demand` from now on: a verb and its value, as a function of the time since then.
  void start(Verb verb, const std::function<double(double)>& demand) {
    arm();
    verb_ = verb;
    demand_ = demand;
    start_s_ = rig.time_s();
  }
  void arm() {
    rig.arm();
    rig.run(0.2);
  }
  void cool(double ratio) {
    host_sim::MuscleChannelSettings muscle = settings_.board.channels[Rig::tested];
    muscle.plant.heat_transfer_W_per_K *= ratio;
    rig.muscle().set(muscle);
  }
  void lose_contact() {
    cool(0.25);
    rig.muscle().faults.slack = true;
  }
  /// Nothing is asked for.
  void rest(double time_s) {
    rig.send(Verb::rest);
    commanding_ = false;
    run(time_s);
    commanding_ = true;
  }
  /// Runs until a fault, or for time_s.
  void run(double time_s) {
    const double end_s = rig.time_s() + time_s;
    while (rig.time_s() < end_s && rig.state() != State::fault) {
      const bool commanding = commanding_ && rig.state() != State::disarmed;
      if (commanding) rig.send(verb_, demand_(rig.time_s() - start_s_));
      rig.tick();
      hottest_C = std::max(hottest_C, 25.0 + rig.muscle().plant().temperature_rise_K());
      const Snapshot& s = rig.snapshot();
      limited = limited || s.limited_by == LimitedBy::unproven;
      const bool under_way = s.state == State::active && rig.time_s() - start_s_ > 1.0;
      if (under_way) min_W = std::min(min_W, s.applied_W);
      // A dither: the power differs from the demand although nothing limits it.
      const double added_W = std::abs(s.applied_W - s.demanded_W);
      dithers += !s.limited && s.state == State::active && added_W > 0.03 ? 1 : 0;
    }
  }

 private:
  test::RigSettings settings_;
  Verb verb_ = Verb::power;
  std::function<double(double)> demand_;
  bool commanding_ = true;
  double start_s_ = 0.0;

 public:
  Rig rig;
  double hottest_C = 0.0;
  bool limited = false;
  double min_W = 1e3;  ///< from 1 s after the start on
  long dithers = 0;
};

/// 2 J/K, a time constant of 27 s, a fifth of the travel: a dither of a second does not move it.
test::RigSettings slow_board() {
  constexpr double slower = 12.0;
  constexpr double weaker = 0.2;
  test::RigSettings s = constant_resistance_board(true);
  ChannelSettings& channel = s.firmware.channels[Rig::tested];
  for (control::PhysicalParameters* muscle :
       {&channel.muscle, &s.board.channels[Rig::tested].plant}) {
    muscle->thermal_mass_J_per_K *= slower;
    muscle->force_per_kelvin_N_per_K *= weaker;
  }
  channel.thermal.bounds.min_mass_J_per_K *= slower;
  channel.thermal.bounds.max_mass_J_per_K *= slower;
  channel.thermal.boot_rise_K = 20.0;  // otherwise arming takes minutes
  return s;
}

test::RigSettings friction_board(double friction_ratio, double response_ratio) {
  test::RigSettings s = constant_resistance_board(true);
  s.board.channels[Rig::tested].effects.friction_ratio = friction_ratio;
  s.firmware.channels[Rig::tested].response_ratio = response_ratio;
  return s;
}

auto always(double value) {
  return [value](double) { return value; };
}

/// Armed again every 12 s.
void run_rearming(LostContact& muscle, int times) {
  for (int i = 0; i < times && muscle.rig.state() != State::fault; ++i) {
    muscle.run(11.7);
    muscle.rig.send(Verb::disarm);
    muscle.run(0.1);
    if (muscle.rig.state() != State::fault) muscle.arm();
  }
}

/// Heats and rests in turn.
void run_resting(LostContact& muscle, double heated_s, double rests_s, double time_s) {
  const double end_s = muscle.rig.time_s() + time_s;
  while (muscle.rig.time_s() < end_s && muscle.rig.state() != State::fault) {
    muscle.run(heated_s);
    if (muscle.rig.state() != State::fault) muscle.rest(rests_s);
  }
}

void check_found(const LostContact& muscle, double hottest_C) {
  CHECK(muscle.rig.fault() == Fault::heater_not_responding);
  CHECK_COMPARE(muscle.hottest_C, <, hottest_C);
}

}  // namespace

TEST_GROUP(LostContact){};

TEST(LostContact, IsFoundDespiteRearmingEvery12Seconds) {
  LostContact muscle(constant_resistance_board(false));
  muscle.start(Verb::power, always(2.9));  // 154 °C in the end
  muscle.run(10.0);
  muscle.lose_contact();
  run_rearming(muscle, 4);
  check_found(muscle, 160.0);
}

TEST(LostContact, IsFoundDespiteRearmingAnIdentifiedMuscle) {
  LostContact muscle(constant_resistance_board(true));
  muscle.start(Verb::power, always(4.0));  // 24 mm; the limit is 25 mm
  muscle.run(5.0);
  muscle.lose_contact();
  run_rearming(muscle, 4);
  check_found(muscle, 120.0);
}

TEST(LostContact, IsFoundDespiteRepeatedRests) {
  for (const auto& [heated_s, rests_s] : {std::pair(1.0, 0.1), {0.5, 0.05}}) {
    LostContact muscle(constant_resistance_board(true));
    muscle.start(Verb::power, always(4.0));
    run_resting(muscle, heated_s, rests_s, 15.0);
    CHECK(muscle.rig.fault() == Fault::none);
    CHECK_FALSE(muscle.limited);
    muscle.lose_contact();
    run_resting(muscle, heated_s, rests_s, 30.0);
    check_found(muscle, 120.0);
  }
}

/// The heating always ends before a dither does.
TEST(LostContact, IsFoundOrLimitedForASlowMuscleThatRestsRepeatedly) {
  LostContact muscle(slow_board());
  muscle.start(Verb::power, always(4.0));
  run_resting(muscle, 5.0, 0.1, 100.0);
  CHECK(muscle.rig.fault() == Fault::none);
  muscle.lose_contact();
  run_resting(muscle, 5.0, 0.1, 300.0);
  CHECK_COMPARE(muscle.hottest_C, <, 135.0);
  CHECK(muscle.rig.fault() == Fault::heater_not_responding || muscle.limited);
}

TEST(LostContact, IsFoundAtConstantPower) {
  for (const double power_W : {1.5, 3.0, 4.0}) {
    for (const double moment_s : {15.0, 15.3, 15.6}) {
      LostContact muscle(constant_resistance_board(true));
      muscle.start(Verb::power, always(power_W));
      muscle.run(moment_s);
      muscle.lose_contact();
      muscle.run(10.0);
      check_found(muscle, 120.0);
    }
  }
}

TEST(LostContact, IsFoundAtAConstantPosition) {
  for (const double controller : {0.0, 1.0, 2.0}) {
    for (const double position_m : {0.010, 0.020}) {
      LostContact muscle(constant_resistance_board(true));
      muscle.rig.send(Verb::controller, controller);
      muscle.start(Verb::position, always(position_m));
      muscle.run(15.0);
      muscle.lose_contact();
      muscle.run(10.0);
      check_found(muscle, 120.0);
    }
  }
}

TEST(LostContact, IsFoundInASlowRamp) {
  LostContact muscle(constant_resistance_board(true));
  muscle.start(Verb::power, [](double t) { return std::min(4.0, 0.04 * t); });
  muscle.run(20.0);
  muscle.lose_contact();
  muscle.run(100.0);
  check_found(muscle, 120.0);
}

TEST(LostContact, IsNotReportedWhenIdentifyMeasuredTheFriction) {
  // As if all of a small motion arrived: the proof fails, power is cut to zero, then limited.
  LostContact unmeasured(friction_board(0.002, 0.0));
  unmeasured.start(Verb::power, always(1.5));
  unmeasured.run(60.0);
  CHECK(unmeasured.limited);
  DOUBLES_EQUAL(0.0, unmeasured.min_W, 1e-9);

  LostContact measured(friction_board(0.002, 0.17));
  measured.start(Verb::power, always(1.5));
  measured.run(60.0);
  CHECK(measured.rig.fault() == Fault::none);
  CHECK_FALSE(measured.limited);
  CHECK_COMPARE(measured.dithers, >, 0);
  measured.lose_contact();
  measured.run(10.0);
  check_found(measured, 120.0);
}

TEST(LostContact, NoDitherAtTheSafePowerWhenFrictionHidesIt) {
  LostContact muscle(friction_board(0.01, 0.001));
  muscle.start(Verb::power, always(3.0));
  muscle.run(60.0);
  CHECK(muscle.rig.fault() == Fault::none);
  CHECK(muscle.limited);
  // 1.1 W from the start, and never cut.
  CHECK_COMPARE(muscle.min_W, >, 1.0);
  CHECK_COMPARE(muscle.rig.snapshot().applied_W, <, 1.2);
  LONGS_EQUAL(0, muscle.dithers);
}

TEST(LostContact, IsFoundForABlockedMuscle) {
  LostContact muscle(constant_resistance_board(true));
  muscle.start(Verb::position, always(0.015));
  muscle.run(15.0);
  muscle.rig.muscle().faults.slack = true;
  muscle.run(10.0);
  check_found(muscle, 120.0);
}

TEST(LostContact, RowsReportThatTheProofIsOff) {
  for (const bool wanted : {true, false}) {
    test::RigSettings settings = constant_resistance_board(true);
    settings.firmware.channels[Rig::tested].supervision.proof_of_response = wanted;
    const LostContact muscle(settings);
    CHECK(((row_of(muscle.rig.snapshot()).flags & row_proof_off) == 0) == wanted);
  }
}

TEST(LostContact, IsNotReportedForAWrappedMuscle) {
  LostContact held(constant_resistance_board(true));
  held.start(Verb::position, always(0.018));
  held.run(15.0);
  held.cool(0.25);
  held.run(60.0);
  CHECK(held.rig.fault() == Fault::none);
  CHECK_COMPARE(held.hottest_C, <, 100.0);

  LostContact driven(constant_resistance_board(true));
  driven.start(Verb::power, always(3.0));
  driven.run(15.0);
  driven.cool(0.25);
  driven.run(60.0);
  CHECK_COMPARE(driven.hottest_C, <, 160.0);
}

TEST(LostContact, IsNotReportedInADraught) {
  for (const double controller : {0.0, 1.0, 2.0}) {
    LostContact muscle(constant_resistance_board(true));
    muscle.rig.send(Verb::controller, controller);
    muscle.start(Verb::position, always(0.012));
    muscle.run(30.0);
    muscle.cool(1.5);
    muscle.run(30.0);
    muscle.cool(1.0);
    muscle.run(30.0);
    CHECK(muscle.rig.fault() == Fault::none);
    CHECK_COMPARE(muscle.dithers, >, 0);
    CHECK_FALSE(muscle.limited);
  }
}

/// The jump of a still position by a new scale is not a response. Without the proof the muscle
/// would reach 148 °C meanwhile.
TEST(LostContact, IsNotHiddenByScaleCommands) {
  LostContact muscle(constant_resistance_board(true));
  muscle.start(Verb::power, always(3.0));
  muscle.run(20.0);
  muscle.lose_contact();
  muscle.limited = false;
  for (int i = 0; i < 40; ++i) {
    const double ratio = i % 2 == 0 ? 1.3 : 1.0 / 1.3;
    muscle.rig.send(Verb::scale, ratio * muscle.rig.snapshot().position_m);
    muscle.run(0.4);
  }
  CHECK(muscle.limited || muscle.rig.state() == State::fault);
  CHECK_COMPARE(muscle.hottest_C, <, 120.0);
}

TEST(LostContact, SineMotionProvesContactWithoutADither) {
  LostContact muscle(constant_resistance_board(true));
  muscle.rig.send(Verb::controller, 2.0);
  muscle.start(Verb::position, [](double t) { return 0.011 + 0.009 * std::sin(0.25 * t); });
  muscle.run(60.0);
  CHECK(muscle.rig.fault() == Fault::none);
  LONGS_EQUAL(0, muscle.dithers);
  CHECK_FALSE(muscle.limited);
}

TEST(LostContact, IsFoundForASlowMuscleAtConstantPower) {
  for (const double power_W : {2.0, 3.0, 4.0}) {
    for (const double moment_s : {100.0, 101.7, 103.3}) {
      LostContact muscle(slow_board());
      muscle.start(Verb::power, always(power_W));
      muscle.run(moment_s);
      CHECK(muscle.rig.fault() == Fault::none);
      CHECK_COMPARE(muscle.rig.snapshot().applied_W, >, 0.7 * power_W);
      muscle.lose_contact();
      muscle.run(60.0);
      check_found(muscle, 135.0);
    }
  }
}

TEST(LostContact, IsFoundForASlowMuscleAndNotConfusedWithADraught) {
  for (const double controller : {0.0, 1.0, 2.0}) {
    LostContact muscle(slow_board());
    muscle.rig.send(Verb::controller, controller);
    muscle.start(Verb::position, always(0.0025));
    muscle.run(200.0);
    for (const double cooling : {1.5, 1.0}) {
      muscle.cool(cooling);
      muscle.run(100.0);
    }
    CHECK(muscle.rig.fault() == Fault::none);
    CHECK_FALSE(muscle.limited);
    muscle.lose_contact();
    muscle.run(60.0);
    check_found(muscle, 135.0);
  }
}

TEST(LostContact, IsNotReportedForASlowMuscleHeldForMinutes) {
  LostContact muscle(slow_board());
  muscle.start(Verb::power, always(2.5));
  muscle.run(400.0);
  CHECK(muscle.rig.fault() == Fault::none);
  CHECK_COMPARE(muscle.dithers, >, 1000);
  // Neither cut nor limited.
  CHECK_COMPARE(muscle.min_W, >, 1.9);
  CHECK_FALSE(muscle.limited);
}
