// Two channels of the simulated board whose muscles share a joint.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "simulated_board/simulated_board.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

namespace {

/// Channels 0 and 1 turn a joint; channel 2 is a single muscle.
SimulatedBoardSettings three_muscles() {
  SimulatedBoardSettings settings;
  settings.channels.resize(3);
  for (MuscleChannelSettings& channel : settings.channels)
    channel.position = {-0.010, 0.010, 0, 0.0};
  settings.joints.resize(1);
  return settings;
}

/// A board without firmware: the supply is on, and each switch has a duty.
struct Driven {
  explicit Driven(const SimulatedBoardSettings& settings) : board(settings) {
    board.pump.stuck_closed = true;
    for (std::size_t i = 0; i < settings.channels.size(); ++i)
      board.channel(i).enable.set(true);
  }
  void duty(std::size_t channel, double duty) {
    SimulatedPwm& pwm = board.channel(channel).pwm;
    pwm.set(static_cast<int>(std::lround(duty * pwm.steps())));
  }
  void run(double time_s) { board.advance_to(board.true_time() + hal::duration_from(time_s)); }
  double rise_K(std::size_t channel) const { return board.channel(channel).temperature_rise_K(); }
  double angle_rad() const { return board.joint(0).plant().angle_rad(); }

  SimulatedBoard board;
};

double position_read_m(const board::ChannelDevices& channel, const ConverterSettings& converter) {
  return converter.low + converter.per_count() * channel.position->latest().counts;
}

}  // namespace

TEST_GROUP(SimulatedJoint){};

TEST(SimulatedJoint, EachMuscleTurnsItInItsDirection) {
  Driven driven(three_muscles());
  driven.duty(0, 0.2);
  driven.run(5.0);
  CHECK_COMPARE(driven.angle_rad(), >, 0.2);
  DOUBLES_EQUAL(0.0, driven.rise_K(1), 0.0);
  driven.duty(0, 0.0);
  driven.duty(1, 0.2);
  driven.run(10.0);
  CHECK_COMPARE(driven.angle_rad(), <, -0.2);
  CHECK_COMPARE(driven.rise_K(1), >, 20.0);
  DOUBLES_EQUAL(driven.board.channel(0).position_m(), -driven.board.channel(1).position_m(), 0.0);
}

TEST(SimulatedJoint, BothChannelsReadTheAgonistsSensor) {
  const SimulatedBoardSettings settings = three_muscles();
  Driven driven(settings);
  const board::Devices devices = driven.board.devices();
  POINTERS_EQUAL(devices.channels[0].position, devices.channels[1].position);
  CHECK(devices.channels[2].position != devices.channels[0].position);
  CHECK(devices.channels[1].current != devices.channels[0].current);
  driven.duty(1, 0.2);
  driven.run(5.0);
  DOUBLES_EQUAL(driven.board.channel(0).position_m(),
                position_read_m(devices.channels[1], settings.channels[0].position), 1e-9);
}

TEST(SimulatedJoint, AnIndependentMuscleBehavesAsOnItsOwnBoard) {
  const SimulatedBoardSettings settings = three_muscles();
  SimulatedBoardSettings own = settings;
  own.channels.resize(1);
  own.joints.clear();
  Driven beside(settings);
  Driven alone(own);
  for (int i = 0; i < 20; ++i) {
    const double duty = i % 3 == 0 ? 0.3 : 0.05;
    beside.duty(0, 0.1);
    beside.duty(2, duty);
    alone.duty(0, duty);
    beside.run(0.5);
    alone.run(0.5);
    DOUBLES_EQUAL(alone.rise_K(0), beside.rise_K(2), 0.0);
    DOUBLES_EQUAL(alone.board.channel(0).plant().position_m(), beside.board.channel(2).position_m(),
                  0.0);
  }
  CHECK_COMPARE(beside.rise_K(2), >, 5.0);
}

TEST(SimulatedJoint, ABrokenHeaterWireLeavesItsMuscleCold) {
  Driven driven(three_muscles());
  driven.board.channel(1).faults.wire_open = true;
  driven.duty(0, 0.1);
  driven.duty(1, 0.1);
  driven.run(5.0);
  DOUBLES_EQUAL(0.0, driven.rise_K(1), 0.0);
  DOUBLES_EQUAL(0.0, driven.board.channel(1).current_A(), 0.0);
  CHECK_COMPARE(driven.angle_rad(), >, 0.1);
}

TEST(SimulatedJoint, AShortAStuckSwitchAndALeakingOneHeatAsTheyDoAlone) {
  const auto both = [](double MuscleFaults::*number, bool MuscleFaults::*flag, double value) {
    Driven driven(three_muscles());
    driven.duty(0, 0.1);
    driven.duty(2, 0.1);
    driven.board.channel(0).enable.set(false);
    driven.board.channel(2).enable.set(false);
    for (const std::size_t i : {0U, 2U}) {
      if (number != nullptr) driven.board.channel(i).faults.*number = value;
      if (flag != nullptr) driven.board.channel(i).faults.*flag = true;
    }
    driven.run(1.0);
    DOUBLES_EQUAL(driven.board.channel(2).current_A(), driven.board.channel(0).current_A(), 1e-12);
    DOUBLES_EQUAL(driven.rise_K(2), driven.rise_K(0), 1e-4);
    return driven.rise_K(0);
  };
  CHECK_COMPARE(both(nullptr, &MuscleFaults::switch_stuck_on, 0.0), >, 50.0);
  CHECK_COMPARE(both(&MuscleFaults::switch_leak_ratio, nullptr, 0.05), >, 3.0);
  CHECK_COMPARE(both(nullptr, &MuscleFaults::enable_stuck_on, 0.0), >, 5.0);
  DOUBLES_EQUAL(0.0, both(&MuscleFaults::short_Ohm, nullptr, 0.5), 0.0);
}

TEST(SimulatedJoint, ATornMuscleLetsTheOtherTurnItToItsEndStop) {
  for (const std::size_t torn : {0U, 1U}) {
    Driven driven(three_muscles());
    driven.run(0.1);
    DOUBLES_EQUAL(0.0, driven.angle_rad(), 0.0);
    driven.board.channel(torn).faults.torn = true;
    driven.run(5.0);
    DOUBLES_EQUAL(0.0, driven.board.joint(0).plant().tension_N(torn), 0.0);
    DOUBLES_EQUAL(torn == 0 ? -1.5 : 1.5, driven.angle_rad(), 1e-12);
  }
}

TEST(SimulatedJoint, ASlackCableLetsTheOtherMuscleTurnItByItsShare) {
  Driven driven(three_muscles());
  driven.run(0.1);
  driven.board.channel(0).faults.slack_m = 0.003;
  driven.run(5.0);
  DOUBLES_EQUAL(-0.5 * 0.003 / 0.015, driven.angle_rad(), 1e-6);
  driven.board.channel(0).faults.slack_m = 0.0;
  driven.run(5.0);
  DOUBLES_EQUAL(0.0, driven.angle_rad(), 1e-6);
}

TEST(SimulatedJoint, ASlackMuscleNoLongerMovesTheSensor) {
  const SimulatedBoardSettings settings = three_muscles();
  Driven driven(settings);
  const board::Devices devices = driven.board.devices();
  driven.board.channel(0).faults.slack = true;
  driven.duty(0, 0.2);
  driven.run(5.0);
  CHECK_COMPARE(driven.angle_rad(), >, 0.2);
  DOUBLES_EQUAL(0.0, position_read_m(devices.channels[1], settings.channels[0].position), 1e-9);
}

TEST(SimulatedJoint, ChangesDuringARunComeFromTheChannels) {
  const SimulatedBoardSettings settings = three_muscles();
  Driven driven(settings);
  MuscleChannelSettings stiff = settings.channels[1];
  stiff.plant.stiffness_N_per_m = 64.0;
  driven.board.channel(1).set(stiff);
  SimulatedJointSettings loaded = settings.joints[0];
  loaded.load_Nm = 0.004;
  driven.board.joint(0).set(loaded);
  driven.run(10.0);
  DOUBLES_EQUAL(-0.004 / (0.015 * 0.015 * (16.0 + 64.0)), driven.angle_rad(), 1e-6);
}
