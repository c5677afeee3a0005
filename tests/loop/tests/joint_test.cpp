// A joint as it is commanded, and how it follows.
#include "loop/joint.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "loop/support/joint_case.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP_BASE(Joint, JointCase){};

TEST(Joint, ArmsRestsAndCoolsAsOne) {
  arm();
  hold(0.002, 0.5);
  CHECK(both(State::active));
  CHECK(of(agonist).mode == Mode::position && of(antagonist).mode == Mode::joint);
  CHECK(rig.answer_of(agonist, Verb::rest) == Refusal::none);
  CHECK(both(State::armed));
  hold(0.002, 0.5);
  CHECK(rig.answer_of(antagonist, Verb::rest) == Refusal::none);
  CHECK(both(State::armed));
  hold(0.002, 0.5);
  CHECK(rig.answer_of(antagonist, Verb::disarm) == Refusal::none);
  CHECK(both(State::disarmed) && both_off());
  CHECK(rig.answer_of(antagonist, Verb::arm) == Refusal::none);
  CHECK(both(State::armed));
}

TEST(Joint, AnswersResetsOfBothMusclesAlike) {
  arm();
  for (const bool same_tick : {true, false}) {
    hold(0.002, 0.5);
    rig.run(1.0);
    CHECK(both(State::fault) && fault_of(antagonist) == Fault::command_timeout);
    rig.send(Verb::reset);
    if (!same_tick) rig.tick();
    rig.loop.send({antagonist, Verb::reset, 0.0});
    rig.tick();
    CHECK(both(State::disarmed));
    CHECK(rig.last_answers[agonist] == Refusal::none);
    CHECK(rig.last_answers[antagonist] == Refusal::none);
    CHECK(rig.answer_of(antagonist, Verb::reset) == Refusal::no_edge);
    rig.run(0.1);
    CHECK(rig.answer_of(antagonist, Verb::reset) == Refusal::wrong_state);
    rig.arm();
  }
}

TEST(Joint, ArmsOnlyWhenBothMusclesMay) {
  rig.boot();
  rig.board.channel(antagonist).current.set(host_sim::ConverterFaults{.silent = true});
  rig.run(0.1);
  CHECK(rig.answer_of(agonist, Verb::arm) != Refusal::none);
  CHECK_FALSE(both(State::armed));
  CHECK_FALSE(state_of(agonist) == State::armed);
}

TEST(Joint, FollowsBothWaysWithTemperaturesInTheirIntervals) {
  arm();
  double squares = 0.0;
  double count = 0.0;
  const auto wave_m = [](double t) { return 20.0 * degree_m * std::sin(0.2 * 3.14159265 * t); };
  follow_for(60.0, wave_m);
  follow_for(
      20.0, [&](double t) { return wave_m(60.0 + t); },
      [&] {
        const double error = of(agonist).model_m / degree_m - angle_deg();
        squares += error * error;
        count += 1.0;
      });
  CHECK_COMPARE(std::sqrt(squares / count), <, 0.05);
  CHECK_FALSE(rig.interval_missed);
  CHECK(both(State::active));
}

TEST(Joint, SettlesAtSetPointsOfBothSigns) {
  arm();
  for (const double wanted_deg : {15.0, -15.0}) {
    hold(wanted_deg * degree_m, 20.0);
    DOUBLES_EQUAL(wanted_deg, angle_deg(), 0.05);
  }
  CHECK_FALSE(rig.interval_missed);
}

TEST(Joint, AgonistMayBeTheLaterChannel) {
  RigSettings settings = joint_board();
  JointSettings& joint = settings.firmware.joints[0];
  std::swap(joint.agonist, joint.antagonist);
  for (std::size_t i = 0; i < settings.firmware.channels.size(); ++i)
    settings.firmware.channels[i].joint = joint.place_of(i);
  Rig turned(settings);
  begin(turned);
  // The sensor and the muscles are as they were: positive is the other way.
  const auto follow = [&] {
    turned.loop.send({antagonist, Verb::position, 15.0 * degree_m});
    return false;
  };
  turned.run_until(follow, 20.0);
  DOUBLES_EQUAL(-15.0, turned.board.joint(0).plant().position_m() / degree_m, 0.05);
  CHECK(turned.loop.channel(antagonist).snapshot().mode == Mode::position);
  CHECK(turned.loop.channel(agonist).snapshot().mode == Mode::joint);
  CHECK_FALSE(turned.interval_missed);
}

TEST(Joint, RangeIsLimitedByBothMusclesTravel) {
  RigSettings settings = joint_board();
  settings.firmware.channels[antagonist].supervision.max_travel_m = 0.005;
  Rig narrow(settings);
  begin(narrow);
  CHECK(narrow.answer_of(agonist, Verb::position, -0.0051) == Refusal::out_of_range);
  CHECK(narrow.answer_of(agonist, Verb::position, -0.0049) == Refusal::none);
  CHECK(narrow.answer_of(agonist, Verb::position, 0.0079) == Refusal::none);
  CHECK(narrow.answer_of(agonist, Verb::position, 0.0081) == Refusal::out_of_range);
}

TEST(Joint, AntagonistRefusesCommandsOfItsOwn) {
  arm();
  CHECK(rig.answer_of(antagonist, Verb::position, 0.001) == Refusal::wrong_state);
  hold(0.002, 0.5);
  CHECK(rig.answer_of(antagonist, Verb::position, 0.001) == Refusal::wrong_state);
  CHECK(rig.answer_of(antagonist, Verb::renew) == Refusal::wrong_state);
  CHECK(rig.answer_of(antagonist, Verb::identify) == Refusal::busy);
  CHECK(rig.answer_of(antagonist, Verb::calibrate) == Refusal::busy);
  CHECK(both(State::active));
}

TEST(Joint, RefusesAScaleForASharedSensor) {
  arm();
  hold(0.002, 0.5);
  CHECK(rig.answer_of(agonist, Verb::rest) == Refusal::none);
  for (const std::uint8_t channel : {agonist, antagonist}) {
    CHECK(rig.answer_of(channel, Verb::scale, 0.002) == Refusal::unsuitable);
    DOUBLES_EQUAL(1.0, rig.loop.channel(channel).known(known_position_scale), 0.0);
  }
}

/// Its only muscle cannot turn it back, and its scale is that of its angle.
TEST(Joint, OfOneMuscleTakesNeitherAScaleNorASetPointBelowRest) {
  RigSettings settings = rough_board();
  settings.firmware.channels[agonist].joint = {.direction = 1, .lever = control::Lever(lever_m)};
  Rig finger(settings);
  begin(finger);
  CHECK(finger.answer_of(agonist, Verb::scale, 0.002) == Refusal::unsuitable);
  CHECK(finger.answer_of(agonist, Verb::position, -1e-6) == Refusal::out_of_range);
  DOUBLES_EQUAL(0.0, finger.last_nearest, 0.0);
  DOUBLES_EQUAL(0.0, finger.loop.channel(agonist).known(known_min_set_point), 0.0);
  // As a program may compute 0.
  CHECK(finger.answer_of(agonist, Verb::position, -1e-17) == Refusal::none);
  CHECK(finger.answer_of(agonist, Verb::position, 0.002) == Refusal::none);
}

TEST(Joint, OneMuscleMayBeDrivenAlone) {
  arm();
  CHECK(rig.answer_of(antagonist, Verb::power, 1.0) == Refusal::none);
  CHECK(state_of(antagonist) == State::active && state_of(agonist) == State::armed);
  for (int i = 0; i < 10; ++i) {
    rig.run(0.1);
    CHECK(rig.answer_of(antagonist, Verb::power, 1.0) == Refusal::none);
  }
  CHECK_COMPARE(angle_deg(), <, -1.0);
  // Measuring the other muscle, or driving both, requires this one to be at rest first.
  CHECK(rig.answer_of(agonist, Verb::position, 0.001) == Refusal::busy);
  CHECK(rig.answer_of(agonist, Verb::identify) == Refusal::busy);
  CHECK(rig.answer_of(agonist, Verb::power, 0.5) == Refusal::none);
  CHECK(both(State::active));
  CHECK(rig.answer_of(antagonist, Verb::rest) == Refusal::none);
  CHECK(state_of(agonist) == State::active && state_of(antagonist) == State::armed);
  // From open loop of one muscle to both.
  hold(0.002, 0.2);
  CHECK(of(antagonist).mode == Mode::joint);
  CHECK(rig.answer_of(agonist, Verb::power, 0.5) == Refusal::none);
  CHECK(of(agonist).mode == Mode::power && state_of(antagonist) == State::armed);
}

TEST(Joint, ArmWaitsUntilTheOtherMuscleIsSurelyCold) {
  RigSettings settings = joint_board();
  settings.firmware.channels[agonist].thermal.boot_rise_K = 20.0;
  Rig fresh(settings);
  fresh.run_until([&] { return fresh.loop.self_test().passed(); }, 2.0);
  fresh.run(0.1);
  CHECK(fresh.answer_of(agonist, Verb::arm) == Refusal::not_ready);
  CHECK(fresh.state() == State::disarmed);
}

TEST(Joint, ZeroIsTakenWhenBothMusclesAreCold) {
  arm();
  rig.run(60.0);  // the probe's heat is gone from the agonist
  for (int i = 0; i < 100; ++i) {
    rig.loop.send({antagonist, Verb::power, 2.0});
    rig.run(0.1);
  }
  CHECK(rig.answer_of(antagonist, Verb::rest) == Refusal::none);
  CHECK(completes_mode(rig, Verb::calibrate, 600.0));
  CHECK(of(agonist).result == ModeResult::found);
  DOUBLES_EQUAL(0.0, rig.loop.channel(agonist).known(known_position_offset), 50e-6);
}

/// Two muscles may cool against each other.
TEST(Joint, StandingStillDoesNotProveThatTheMusclesAreCold) {
  const RigSettings settings = known_joint(3.0);
  Rig fresh(settings);
  begin(fresh);
  const auto hottest_K = [&] {
    return fresh.loop.channel(antagonist).snapshot().hottest_C -
           settings.firmware.channels[antagonist].thermal.air.warmest_C;
  };
  CHECK_COMPARE(hottest_K(), >, 20.0);
  CHECK(completes_mode(fresh, Verb::calibrate, 600.0));
  CHECK(fresh.loop.channel(agonist).snapshot().result == ModeResult::found);
  CHECK_COMPARE(hottest_K(), <, 1.0);
}

/// Its law learns of either heater's limit, and does not wind up.
TEST(Joint, ReturnsWithoutWindupFromAnUnreachableAngle) {
  RigSettings settings = joint_board();
  settings.firmware.channels[antagonist].limiter.max_W = 1.0;
  Rig fresh(settings);
  begin(fresh);
  fresh.send(Verb::controller, 1);  // pi, which has an integral
  double reference_m = -0.0075;
  const auto wanted = [&] { return reference_m; };
  CHECK_FALSE(faults_while_following(fresh, 60.0, wanted));
  CHECK_COMPARE(fresh.snapshot().position_m, >, -0.006);
  reference_m = 0.0;
  CHECK_FALSE(faults_while_following(fresh, 6.0, wanted));
  DOUBLES_EQUAL(0.0, fresh.snapshot().position_m, 0.3e-3);
}

/// A knot is judged by what both muscles together can do.
TEST(Joint, AcceptsATrajectoryThatNeedsTheAntagonist) {
  arm();
  hold(0.0, 5.0);
  const auto knot = [](double after_s, double position_m) {
    Command command{agonist, Verb::knot, position_m};
    command.after_s = static_cast<float>(after_s);
    return command;
  };
  for (const Command& command : {knot(0.0, 0.0), knot(3.0, -0.003), knot(1.0, -0.003)}) {
    rig.loop.send(command);
    rig.tick();
    CHECK(rig.last_answers.at(agonist) == Refusal::none);
  }
}

TEST(Joint, IdentifiesEachMuscleInTheJoint) {
  arm();
  for (const std::uint8_t tested : {agonist, antagonist}) {
    CHECK(rig.answer_of(tested, Verb::identify) == Refusal::none);
    const auto ended = [&] {
      rig.loop.send({tested, Verb::renew, 0.0});
      return state_of(tested) != State::active;
    };
    CHECK(rig.run_until(ended, 400.0));
    STRCMP_EQUAL(
        "found",
        std::string(mode_result_names.at(static_cast<std::size_t>(of(tested).result))).c_str());
    // The gain of this muscle alone, in the joint of both springs.
    const control::PhysicalParameters& p = rig.board.channel(tested).settings().plant;
    const double gain_m_per_W = p.force_per_kelvin_N_per_K / (p.heat_transfer_W_per_K * 32.0);
    const Channel& channel = rig.loop.channel(tested);
    const double found_m_per_W = channel.known(5) / (channel.known(1) * channel.known(2));
    DOUBLES_EQUAL(1.0, found_m_per_W / gain_m_per_W, 0.03);
    rig.run(10.0);
  }
  // With known muscles, holding for minutes is not a fault either.
  hold(10.0 * degree_m, 180.0);
  CHECK(both(State::active));
  DOUBLES_EQUAL(10.0, angle_deg(), 0.1);
  CHECK_FALSE(rig.interval_missed);
}

TEST(Joint, IdentifyOfTheAgonistContinuesWithTheAntagonist) {
  arm();
  CHECK(rig.answer_of(agonist, Verb::identify) == Refusal::none);
  float progress = 0.0F;
  double agonist_s = 0.0;
  bool first = true;
  CHECK(rig.run_until(
      [&] {
        rig.send(Verb::renew);
        first = first && of(antagonist).mode == Mode::rest;
        if (first) agonist_s = rig.time_s();
        if (state_of(agonist) != State::active) return true;
        CHECK(of(agonist).mode == Mode::identify && of(agonist).result == ModeResult::running);
        CHECK(first ? of(agonist).progress <= 0.5F : of(agonist).progress >= 0.5F);
        progress = std::max(progress, of(agonist).progress);
        return false;
      },
      400.0));
  CHECK(both(State::armed));
  for (const std::uint8_t channel : {agonist, antagonist}) {
    CHECK(of(channel).result == ModeResult::found);
    CHECK_COMPARE(rig.loop.channel(channel).known(known_theta1_deviation + 3), <, 0.1);
  }
  CHECK_COMPARE(progress, >, 0.9F);
  CHECK_COMPARE(rig.time_s() - agonist_s, >, 20.0);
}

TEST(Joint, RefusesPowerWhileTheOtherMuscleIsMeasured) {
  arm();
  CHECK(rig.answer_of(agonist, Verb::identify) == Refusal::none);
  CHECK(rig.answer_of(antagonist, Verb::power, 1.0) == Refusal::busy);
  CHECK(rig.answer_of(agonist, Verb::rest) == Refusal::none);
  CHECK(rig.answer_of(antagonist, Verb::calibrate) == Refusal::none);
  CHECK(rig.answer_of(agonist, Verb::power, 1.0) == Refusal::busy);
}

TEST(Joint, CalibrateOfTheAgonistContinuesWithTheAntagonist) {
  arm();
  CHECK(completes_mode(rig, Verb::calibrate, 200.0));
  for (const std::uint8_t channel : {agonist, antagonist})
    CHECK(of(channel).result == ModeResult::found);
}

TEST(Joint, EndingEitherMuscleEndsIdentify) {
  const auto identify_antagonist = [&] {
    CHECK(rig.answer_of(agonist, Verb::identify) == Refusal::none);
    CHECK(rig.run_until(
        [&] {
          rig.send(Verb::renew);
          return of(antagonist).mode == Mode::identify;
        },
        200.0));
    rig.tick();
    CHECK(both(State::active));
  };
  arm();
  identify_antagonist();
  CHECK(rig.answer_of(antagonist, Verb::renew) == Refusal::wrong_state);
  CHECK(rig.answer_of(agonist, Verb::position, 0.001) == Refusal::busy);
  CHECK(rig.answer_of(agonist, Verb::power, 1.0) == Refusal::busy);
  CHECK(rig.answer_of(antagonist, Verb::power, 1.0) == Refusal::busy);
  CHECK(rig.answer_of(agonist, Verb::rest) == Refusal::none);
  CHECK(both(State::armed));
  rig.tick();
  CHECK(of(antagonist).result == ModeResult::interrupted);
  CHECK(of(agonist).result == ModeResult::found);
  identify_antagonist();
  CHECK(rig.answer_of(antagonist, Verb::rest) == Refusal::none);
  rig.run_ticks(2);
  CHECK(both(State::armed));
  identify_antagonist();
  rig.run(1.0);  // nothing is renewed
  CHECK(both(State::fault) && both_off());
  CHECK(fault_of(agonist) == Fault::command_timeout);
}
