// Two muscles of a rough board that turn one joint against each other.
#include "loop/joint.hpp"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr std::uint8_t agonist = Rig::tested;
constexpr std::uint8_t antagonist = Rig::neighbour;
constexpr double lever_m = 0.015;
constexpr double degree_m = lever_m * 3.14159265358979 / 180.0;

/// Both muscles are known as they are, as after identify. Resistance tells no temperature here: it
/// would tell sooner what is wrong.
RigSettings known_joint(double co_contraction_W) {
  RigSettings settings = joint_board();
  for (std::size_t i = 0; i < settings.firmware.channels.size(); ++i) {
    ChannelSettings& channel = settings.firmware.channels[i];
    host_sim::MuscleChannelSettings& muscle = settings.board.channels[i];
    channel.muscle.heat_transfer_W_per_K = muscle.plant.heat_transfer_W_per_K;
    channel.muscle.force_per_kelvin_N_per_K = muscle.plant.force_per_kelvin_N_per_K;
    channel.muscle_identified = true;
    channel.heater.temperature_coefficient_per_K = 0.0;
    muscle.temperature_coefficient_per_K = 0.0;
  }
  settings.firmware.joints[0].co_contraction_W = co_contraction_W;
  return settings;
}

void begin(Rig& rig) {
  rig.boot();
  rig.arm();
  rig.run(0.2);
}

/// Whether it ends in a fault before max_s.
bool follows_until_fault(Rig& rig, double max_s, const std::function<double()>& reference_m) {
  return rig.run_until(
      [&] {
        rig.send(Verb::position, reference_m());
        return rig.state() == State::fault;
      },
      max_s);
}

}  // namespace

TEST_GROUP(Joint) {
  Rig rig{joint_board()};

  State state_of(std::uint8_t channel) {
    return rig.loop.channel(channel).state().state();
  }
  Fault fault_of(std::uint8_t channel) {
    return rig.loop.channel(channel).state().first_cause();
  }
  const Snapshot& of(std::uint8_t channel) {
    return rig.loop.channel(channel).snapshot();
  }
  double angle_deg() {
    return rig.board.joint(0).plant().position_m() / degree_m;
  }
  bool both(State state) {
    return state_of(agonist) == state && state_of(antagonist) == state;
  }
  bool both_off() {
    bool off = true;
    for (const std::uint8_t i : {agonist, antagonist}) {
      host_sim::MuscleChannel& muscle = rig.board.channel(i);
      off = off && !muscle.enable.high() && muscle.pwm.duty(rig.board.true_time()) == 0.0;
    }
    return off;
  }

  void arm() {
    rig.boot();
    rig.arm();
    CHECK(both(State::armed));
    rig.run(0.2);
  }
  void follow(double position_m) {
    rig.send(Verb::position, position_m);
  }
  /// Renewed at each tick; reference of the time since now.
  void follow_for(
      double time_s, const std::function<double(double)>& reference_m,
      const std::function<void()>& look = [] {}) {
    const double from_s = rig.time_s();
    while (rig.time_s() - from_s < time_s) {
      follow(reference_m(rig.time_s() - from_s));
      rig.tick();
      look();
    }
  }
  void hold(double position_m, double time_s) {
    follow_for(time_s, [=](double) { return position_m; });
  }
};

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

TEST(Joint, IsArmedOnlyWhenBothMusclesMayBe) {
  rig.boot();
  rig.board.channel(antagonist).current.set(host_sim::ConverterFaults{.silent = true});
  rig.run(0.1);
  CHECK(rig.answer_of(agonist, Verb::arm) != Refusal::none);
  CHECK_FALSE(both(State::armed));
  CHECK_FALSE(state_of(agonist) == State::armed);
}

TEST(Joint, FollowsBothWaysAndEachTemperatureStaysInItsInterval) {
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

TEST(Joint, PowerToTheAntagonistChangesWithWhatBothPullAndHardlyTheAngle) {
  arm();
  hold(5.0 * degree_m, 60.0);
  const host_sim::JointPlant& plant = rig.board.joint(0).plant();
  const double before_N = plant.tension_N(0) + plant.tension_N(1);
  const double before_W = of(antagonist).reference;
  CHECK(rig.answer_of(antagonist, Verb::power, 2.0 * before_W) == Refusal::none);
  hold(5.0 * degree_m, 3.0);
  const double soon_N = plant.tension_N(0) + plant.tension_N(1);
  double most_deg = 0.0;
  follow_for(
      60.0, [](double) { return 5.0 * degree_m; },
      [&] { most_deg = std::fmax(most_deg, std::abs(angle_deg() - 5.0)); });
  CHECK_COMPARE(most_deg, <, 0.1);
  const double after_N = plant.tension_N(0) + plant.tension_N(1);
  CHECK_COMPARE(after_N, >, before_N + 0.05);
  // Slow against every controller.
  CHECK_COMPARE(soon_N - before_N, <, 0.2 * (after_N - before_N));
  DOUBLES_EQUAL(2.0 * before_W, of(antagonist).reference, 1e-12);
  // More than the heater may have is refused, and the nearest told; so is what is no number.
  for (const double wrong_W : {-0.1, 4.6, static_cast<double>(NAN)})
    CHECK(rig.answer_of(antagonist, Verb::power, wrong_W) == Refusal::out_of_range);
  DOUBLES_EQUAL(2.0 * before_W, of(antagonist).reference, 1e-12);
}

/// The limit is in watts of the agonist; the ratio of gains makes watts of the antagonist of it.
TEST(Joint, PullsNoHarderThanTheLimitOfTheJoint) {
  RigSettings settings = joint_board();
  settings.firmware.joints[0].max_co_contraction_W = 1.2;
  const double gain_ratio = settings.firmware.channels[antagonist].muscle.dc_gain_m_per_W() /
                            settings.firmware.channels[agonist].muscle.dc_gain_m_per_W();
  Rig fresh(settings);
  begin(fresh);
  CHECK_FALSE(follows_until_fault(fresh, 1.0, [] { return 0.0; }));
  CHECK(fresh.answer_of(antagonist, Verb::power, 1.21 / gain_ratio) == Refusal::out_of_range);
  CHECK(fresh.answer_of(antagonist, Verb::power, 1.2 / gain_ratio) == Refusal::none);
  CHECK_FALSE(follows_until_fault(fresh, 60.0, [] { return 0.0; }));
  CHECK_COMPARE(fresh.loop.channel(antagonist).snapshot().applied_W, <, 1.25 / gain_ratio);
  CHECK_COMPARE(fresh.loop.channel(antagonist).snapshot().applied_W, >, 1.0 / gain_ratio);
  // By itself the muscle may have all that its heater may.
  CHECK(fresh.answer_of(antagonist, Verb::rest) == Refusal::none);
  CHECK(fresh.answer_of(antagonist, Verb::power, 2.0) == Refusal::none);
}

TEST(Joint, AntagonistIsNotCommandedByItselfWhileItIsLed) {
  arm();
  CHECK(rig.answer_of(antagonist, Verb::position, 0.001) == Refusal::wrong_state);
  hold(0.002, 0.5);
  CHECK(rig.answer_of(antagonist, Verb::position, 0.001) == Refusal::wrong_state);
  CHECK(rig.answer_of(antagonist, Verb::renew) == Refusal::wrong_state);
  CHECK(rig.answer_of(antagonist, Verb::identify) == Refusal::busy);
  CHECK(rig.answer_of(antagonist, Verb::calibrate) == Refusal::busy);
  CHECK(both(State::active));
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
  // What measures the other muscle, and what drives both, wants this one at rest first.
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

TEST(Joint, WithoutCommandsBothGoColdAtTheTimeout) {
  arm();
  hold(0.002, 1.0);
  rig.run(0.24);
  CHECK(both(State::active));
  rig.run(0.02);
  CHECK(both(State::fault) && both_off());
  CHECK(fault_of(agonist) == Fault::command_timeout);
  CHECK(fault_of(antagonist) == Fault::command_timeout);
}

TEST(Joint, AFaultOfEitherChannelCoolsBothInTheSameTickAndBothTellIt) {
  using Inject = std::function<void(host_sim::MuscleChannel&, bool)>;
  const std::vector<std::pair<Fault, Inject>> cases{
      {Fault::heater_open, [](host_sim::MuscleChannel& m, bool on) { m.faults.wire_open = on; }},
      {Fault::heater_short,
       [](host_sim::MuscleChannel& m, bool on) { m.faults.short_Ohm = on ? 0.5 : 0.0; }},
      {Fault::sensor_stale,
       [](host_sim::MuscleChannel& m, bool on) {
         m.current.set(host_sim::ConverterFaults{.silent = on});
       }},
      {Fault::duty_wrong,
       [](host_sim::MuscleChannel& m, bool on) {
         m.pwm.refuses = on ? hal::Status::io_error : hal::Status::ok;
       }},
  };
  arm();
  for (const auto& [fault, inject] : cases) {
    for (const std::uint8_t where : {agonist, antagonist}) {
      // Towards where this muscle pulls: the other one may get nothing yet.
      const double towards_m = where == agonist ? 0.002 : -0.002;
      hold(towards_m, 1.0);
      CHECK(both(State::active));
      inject(rig.board.channel(where), true);
      CHECK(rig.run_until(
          [&] {
            follow(towards_m);
            return state_of(agonist) == State::fault || state_of(antagonist) == State::fault;
          },
          0.1));
      CHECK(both(State::fault));
      CHECK(fault_of(agonist) == fault && fault_of(antagonist) == fault);
      // While the cause is there, neither is reset.
      if (fault == Fault::sensor_stale) {
        CHECK(rig.answer_of(agonist, Verb::reset) == Refusal::cause_persists);
        CHECK(both(State::fault));
      }
      inject(rig.board.channel(where), false);
      rig.run(0.2);
      CHECK(both_off());
      CHECK(rig.answer_of(where == agonist ? antagonist : agonist, Verb::reset) == Refusal::none);
      CHECK(both(State::disarmed));
      rig.run(5.0);
      CHECK(rig.answer_of(agonist, Verb::arm) == Refusal::none);
      rig.run(0.2);
    }
  }
  CHECK_FALSE(rig.interval_missed);
}

TEST(Joint, ATornMuscleIsFoundAtOnceAndBothAreCold) {
  for (const std::uint8_t torn : {agonist, antagonist}) {
    Rig fresh{joint_board()};
    fresh.boot();
    fresh.arm();
    fresh.run(0.2);
    fresh.scale = 0.2;
    fresh.heat(Task::position);
    fresh.run(20.0);
    fresh.board.channel(torn).faults.torn = true;
    CHECK(fresh.run_until([&] { return fresh.state() == State::fault; }, 0.1));
    CHECK(fresh.loop.channel(antagonist).state().state() == State::fault);
    CHECK_FALSE(fresh.interval_missed);
  }
}

/// Its end stops lie within its travel: nothing is out of range, and nothing follows.
TEST(Joint, AMuscleThatMovesNothingIsFoundWithinTwoSecondsWhereTheJointStaysInItsTravel) {
  using Inject = std::function<void(host_sim::MuscleFaults&)>;
  const std::vector<Inject> ways{[](host_sim::MuscleFaults& f) { f.torn = true; },
                                 [](host_sim::MuscleFaults& f) { f.slack_m = 0.2; }};
  for (const std::uint8_t loose : {agonist, antagonist}) {
    for (const Inject& inject : ways) {
      RigSettings settings = known_joint(0.8);
      settings.board.joints[0].plant.min_angle_rad = -0.4;
      settings.board.joints[0].plant.max_angle_rad = 0.4;
      Rig fresh(settings);
      begin(fresh);
      CHECK_FALSE(follows_until_fault(fresh, 20.0, [] { return 0.0; }));
      inject(fresh.board.channel(loose).faults);
      CHECK(follows_until_fault(fresh, 2.0, [] { return 0.0; }));
      CHECK(fresh.fault() == Fault::muscle_loose);
      CHECK(fresh.loop.channel(antagonist).state().first_cause() == Fault::muscle_loose);
      CHECK_FALSE(fresh.interval_missed);
    }
  }
}

/// A load that comes at once is no loose muscle, whether the muscle can hold it or gives all that
/// it may and is drawn out.
TEST(Joint, ALoadThatMovesItIsNoLooseMuscle) {
  double limited_s = 0.0;
  for (const double load_Nm : {-0.0008, 0.0008, -0.004, 0.004}) {
    Rig fresh(known_joint(0.8));
    begin(fresh);
    CHECK_FALSE(follows_until_fault(fresh, 20.0, [] { return 0.0; }));
    host_sim::SimulatedJointSettings loaded = fresh.board.joint(0).settings();
    loaded.load_Nm = load_Nm;
    fresh.board.joint(0).set(loaded);
    CHECK_FALSE(follows_until_fault(fresh, 60.0, [&] {
      for (const std::uint8_t channel : {agonist, antagonist}) {
        if (fresh.loop.channel(channel).snapshot().limited) limited_s += fresh.period_s();
      }
      return 0.0;
    }));
  }
  CHECK_COMPARE(limited_s, >, 5.0);
}

TEST(Joint, ACurrentThatIsNoNumberOfTheAntagonistMakesBothSafe) {
  arm();
  hold(0.002, 1.0);
  rig.board.channel(antagonist)
      .current.set(host_sim::ConverterFaults{.status = hal::Status::io_error});
  CHECK(rig.run_until(
      [&] {
        follow(0.002);
        return both(State::fault);
      },
      0.1));
}

TEST(Joint, WaitsForTheOtherMuscleThatMayBeHotFromBefore) {
  RigSettings settings = joint_board();
  settings.firmware.channels[agonist].thermal.boot_rise_K = 20.0;
  Rig fresh(settings);
  fresh.run_until([&] { return fresh.loop.self_test().passed(); }, 2.0);
  fresh.run(0.1);
  CHECK(fresh.answer_of(agonist, Verb::arm) == Refusal::not_ready);
  CHECK(fresh.state() == State::disarmed);
}

TEST(Joint, ItsZeroIsTakenWhenBothMusclesAreCold) {
  arm();
  rig.run(60.0);  // the probe's heat is gone from the agonist
  for (int i = 0; i < 100; ++i) {
    rig.loop.send({antagonist, Verb::power, 2.0});
    rig.run(0.1);
  }
  CHECK(rig.answer_of(antagonist, Verb::rest) == Refusal::none);
  CHECK(rig.answer_of(agonist, Verb::calibrate) == Refusal::none);
  CHECK(rig.run_until(
      [&] {
        rig.send(Verb::renew);
        return state_of(agonist) != State::active;
      },
      600.0));
  CHECK(of(agonist).result == ModeResult::found);
  DOUBLES_EQUAL(0.0, rig.loop.channel(agonist).known(known_position_offset), 50e-6);
}

TEST(Joint, PullsAgainstItselfForMinutesWithoutAFault) {
  for (const bool known : {false, true}) {
    RigSettings settings = known_joint(3.0);
    for (ChannelSettings& channel : settings.firmware.channels)
      channel.muscle_identified = known;
    Rig fresh(settings);
    begin(fresh);
    CHECK_FALSE(follows_until_fault(fresh, 300.0, [] { return 0.0; }));
    CHECK_FALSE(fresh.interval_missed);
  }
}

/// Its law hears of either heater's limit, and winds nothing up.
TEST(Joint, ComesBackAtOnceFromWhatItsAntagonistCannotReach) {
  RigSettings settings = joint_board();
  settings.firmware.channels[antagonist].limiter.max_W = 1.0;
  Rig fresh(settings);
  begin(fresh);
  fresh.send(Verb::controller, 1);  // pi, which has an integral
  double reference_m = -0.0075;
  const auto wanted = [&] { return reference_m; };
  CHECK_FALSE(follows_until_fault(fresh, 60.0, wanted));
  CHECK_COMPARE(fresh.snapshot().position_m, >, -0.006);
  reference_m = 0.0;
  CHECK_FALSE(follows_until_fault(fresh, 6.0, wanted));
  DOUBLES_EQUAL(0.0, fresh.snapshot().position_m, 0.3e-3);
}

/// By what both muscles together can do a knot is judged.
TEST(Joint, PlaysATrajectoryThatTakesTheAntagonist) {
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

/// The other muscle gives what a hot one may not: nothing stays limited.
TEST(Joint, PullsLessWhereOneMuscleIsAsHotAsItMayBe) {
  RigSettings settings = joint_board();
  settings.firmware.joints[0].co_contraction_W = 3.0;
  settings.firmware.channels[agonist].thermal.boot_rise_K = 20.0;  // else it waits for a minute
  settings.firmware.channels[agonist].limiter.derate_from_C = 50.0;
  settings.firmware.channels[agonist].limiter.derate_to_C = 90.0;
  Rig fresh(settings);
  begin(fresh);
  CHECK_FALSE(follows_until_fault(fresh, 300.0, [] { return 0.0; }));
  DOUBLES_EQUAL(0.0, fresh.snapshot().position_m, 0.1e-3);
  CHECK(fresh.snapshot().limited_by == LimitedBy::nothing);
}

TEST(Joint, BeginsEachTimeWithoutCoContraction) {
  arm();
  hold(0.0, 60.0);
  CHECK_COMPARE(of(antagonist).applied_W, >, 0.5);
  CHECK(rig.answer_of(agonist, Verb::rest) == Refusal::none);
  rig.run(20.0);
  hold(0.0, 0.5);
  CHECK_COMPARE(of(antagonist).applied_W, <, 0.1);
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
  // A hold of minutes is no fault of known muscles either.
  hold(10.0 * degree_m, 180.0);
  CHECK(both(State::active));
  DOUBLES_EQUAL(10.0, angle_deg(), 0.1);
  CHECK_FALSE(rig.interval_missed);
}
