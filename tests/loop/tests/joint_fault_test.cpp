// A joint whose muscles, sensors or commands fail.
#include <functional>
#include <utility>
#include <vector>

#include "loop/joint.hpp"
#include "loop/support/joint_case.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP_BASE(JointFault, JointCase){};

TEST(JointFault, CommandTimeoutSwitchesBothOff) {
  arm();
  hold(0.002, 1.0);
  rig.run(0.24);
  CHECK(both(State::active));
  rig.run(0.02);
  CHECK(both(State::fault) && both_off());
  CHECK(fault_of(agonist) == Fault::command_timeout);
  CHECK(fault_of(antagonist) == Fault::command_timeout);
}

TEST(JointFault, AFaultOfEitherChannelSwitchesBothOffInTheSameTick) {
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
      // In the direction in which this muscle pulls: the other one may get no power yet.
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

TEST(JointFault, ATornMuscleIsFoundAtOnce) {
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
TEST(JointFault, ALooseMuscleIsFoundWithinTwoSeconds) {
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
      CHECK_FALSE(faults_while_following(fresh, 20.0, [] { return 0.0; }));
      inject(fresh.board.channel(loose).faults);
      CHECK(faults_while_following(fresh, 2.0, [] { return 0.0; }));
      CHECK(fresh.fault() == Fault::muscle_loose);
      CHECK(fresh.loop.channel(antagonist).state().first_cause() == Fault::muscle_loose);
      CHECK_FALSE(fresh.interval_missed);
    }
  }
}

/// As with both heaters swapped: the controller would drive it to the other end.
TEST(JointFault, ASensorWithTheWrongSignIsFoundAtTheFirstMotion) {
  for (const double to_m : {0.004, -0.004}) {
    Rig fresh(known_joint(0.8));
    fresh.board.channel(agonist).position.set(host_sim::ConverterFaults{.gain = -1.0});
    begin(fresh);
    CHECK(faults_while_following(fresh, 3.0, [=] { return to_m; }));
    CHECK(fresh.fault() == Fault::muscle_loose);
    CHECK_COMPARE(std::abs(fresh.board.joint(0).plant().position_m()), <, 0.006);
  }
}

TEST(JointFault, IdentifyReportsBackwardMotion) {
  rig.board.channel(agonist).position.set(host_sim::ConverterFaults{.gain = -1.0});
  arm();
  CHECK(rig.answer_of(agonist, Verb::identify) == Refusal::none);
  double moved_m = 0.0;
  CHECK(rig.run_until(
      [&] {
        rig.send(Verb::renew);
        moved_m = std::max(moved_m, rig.board.joint(0).plant().position_m());
        return state_of(agonist) != State::active;
      },
      60.0));
  CHECK(of(agonist).result == ModeResult::moved_backwards);
  LONGS_EQUAL(0, of(agonist).identify_notes & note_too_little_motion);
  CHECK_FALSE(both(State::fault));
  // A tenth of the travel of 8 mm shows it; heat that is on its way adds to the motion.
  CHECK_COMPARE(moved_m, <, 0.0012);
}

/// The motion expected of one muscle is subtracted in the other one's detectors.
TEST(JointFault, IdentifyRestartsBothMusclesWindows) {
  RigSettings settings = joint_board();
  settings.firmware.channels[agonist].muscle.force_per_kelvin_N_per_K *= 1.4;
  Rig fresh(settings);
  begin(fresh);
  CHECK(completes_mode(fresh, Verb::identify, 400.0));
  CHECK(fresh.snapshot().result == ModeResult::found);
  fresh.run_ticks(3);
  for (const std::uint8_t channel : {agonist, antagonist}) {
    const auto margin = fresh.loop.channel(channel).verdict().margin(Fault::heater_not_responding);
    CHECK_COMPARE(margin.measured, <, 1e-4);
    CHECK_FALSE(margin.judged);
  }
}

/// A millimetre is 30 K of the weak one.
TEST(JointFault, AWrongBeliefOfAStrongMuscleIsNoDisagreementOfAWeakOne) {
  RigSettings settings = joint_board();
  constexpr double weak = 0.1;
  settings.board.channels[antagonist].plant.force_per_kelvin_N_per_K *= weak;
  settings.firmware.channels[antagonist].muscle.force_per_kelvin_N_per_K *= weak;
  settings.firmware.channels[agonist].muscle.force_per_kelvin_N_per_K *= 0.35;
  Rig uneven(settings);
  begin(uneven);
  const auto faults = [&] {
    uneven.loop.send({agonist, Verb::power, 1.5});
    uneven.loop.send({antagonist, Verb::power, 1.0});
    return uneven.state() == State::fault;
  };
  CHECK_FALSE(uneven.run_until(faults, 15.0));
}

/// A load that comes at once is not a loose muscle, whether the muscle can hold it or is drawn out
/// at the most power that it may have.
TEST(JointFault, AMovingLoadIsNotALooseMuscle) {
  double limited_s = 0.0;
  for (const double load_Nm : {-0.0008, 0.0008, -0.004, 0.004}) {
    Rig fresh(known_joint(0.8));
    begin(fresh);
    CHECK_FALSE(faults_while_following(fresh, 20.0, [] { return 0.0; }));
    host_sim::SimulatedJointSettings loaded = fresh.board.joint(0).settings();
    loaded.load_Nm = load_Nm;
    fresh.board.joint(0).set(loaded);
    CHECK_FALSE(faults_while_following(fresh, 60.0, [&] {
      for (const std::uint8_t channel : {agonist, antagonist}) {
        if (fresh.loop.channel(channel).snapshot().limited) limited_s += fresh.period_s();
      }
      return 0.0;
    }));
  }
  CHECK_COMPARE(limited_s, >, 5.0);
}

TEST(JointFault, AnUnreadableAntagonistCurrentIsAFaultOfBoth) {
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
