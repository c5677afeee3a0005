// Which inputs cause which fault of a channel, after which time, and that they cause no other.
#include "supervisor/channel_supervisor.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil;
using supercoil::test::tick_s;

namespace {

struct ChannelInputs {
  AxisInputs axis;
  HeaterInputs heater;
  CommandInputs commands;
};

/// A muscle of 10 Ohm, heated with 3.6 W, hot and at its expected position.
class Channel {
 public:
  ChannelInputs inputs;
  ChannelSupervisor supervisor{ChannelSupervision{}, 10.0, 10.8, 0.0, tick_s};
  bool sensor_lives = true;

  Channel() {
    ChannelInputs& e = inputs;
    e.axis.position = {0.01, 0.0, true, hal::Status::ok};
    e.axis.sensor_m = 0.01;
    e.axis.position_elapsed_s = tick_s;
    e.heater.current = {0.3, 0.0, true, hal::Status::ok};
    e.heater.supply_V = 12.0;
    e.heater.hot = e.commands.heating = true;
    e.heater.off = false;
    e.heater.duty = 0.25;
    e.heater.set_step = e.heater.read_back = 1000;
    e.heater.expected_m = {0.01, 0.01, 0.01};
    e.heater.hottest_C = 100.0;
    e.heater.applied_W = e.heater.measured_W = e.axis.demanded_W = 3.6;
    e.heater.resistance_Ohm = e.heater.min_Ohm = e.heater.max_Ohm = 10.0;
    e.commands.renewed = e.commands.obeyed = true;
  }
  Fault step() {
    if (sensor_lives) noise_m_ = -noise_m_;
    ChannelInputs now = inputs;
    now.axis.position.value += 0.1 * noise_m_;  // at a short lever
    now.axis.sensor_m += noise_m_;
    return supervisor.step(now.axis, now.heater, now.commands);
  }
  double moved_m() const {
    return supervisor.verdict().margin(Fault::heater_not_responding).measured;
  }

 private:
  double noise_m_ = 15e-6;
};

struct InjectedFault {
  Fault fault;
  int ticks;  ///< until it is found
  std::function<void(ChannelInputs&)> begins;
};

void drift(ChannelInputs& e) {
  e.heater.resistance_fresh = true;
  e.heater.resistance_Ohm = 13.1;
}

const std::vector<InjectedFault> injected_faults{
    {Fault::sensor_stale, 1, [](ChannelInputs& e) { e.axis.position.present = false; }},
    {Fault::sensor_stale, 1, [](ChannelInputs& e) { e.heater.current.present = false; }},
    {Fault::sensor_out_of_range, 5, [](ChannelInputs& e) { e.axis.sensor_m = 0.0421; }},
    {Fault::sensor_out_of_range, 5, [](ChannelInputs& e) { e.axis.sensor_m = -0.0021; }},
    {Fault::sensor_jump, 2, [](ChannelInputs& e) { e.axis.sensor_m = 0.0108; }},
    {Fault::sensors_disagree, 2000, [](ChannelInputs& e) { e.heater.from_resistance_K = 30.1; }},
    {Fault::heater_open, 20, [](ChannelInputs& e) { e.heater.current.value = 0.067; }},
    {Fault::heater_open, 1, [](ChannelInputs& e) { e.heater.probe_failed = true; }},
    {Fault::heater_short, 2, [](ChannelInputs& e) { e.heater.current.value = 0.651; }},
    {Fault::heater_stuck_on, 50,
     [](ChannelInputs& e) {
       e.heater.off = true;
       e.heater.current.value = 0.051;
     }},
    {Fault::heater_not_responding, 1,
     [](ChannelInputs& e) {
       e.axis.unanswered = true;
       e.axis.answer = {0.001, 0.002, true, true};
     }},
    {Fault::duty_wrong, 5, [](ChannelInputs& e) { e.heater.read_back = 1001; }},
    {Fault::duty_wrong, 5, [](ChannelInputs& e) { e.heater.devices_ok = false; }},
    {Fault::over_temperature, 1, [](ChannelInputs& e) { e.heater.hottest_C = 160.1; }},
    {Fault::over_temperature, 1, [](ChannelInputs& e) { e.heater.hottest_C = std::nan(""); }},
    {Fault::over_travel, 1, [](ChannelInputs& e) { e.axis.position.value = 0.0351; }},
    {Fault::energy_budget_exceeded, 1,
     [](ChannelInputs& e) { e.heater.measured_W = 298.0 / tick_s; }},
    {Fault::resistance_drift, 500, drift},
    {Fault::resistance_drift, 1,
     [](ChannelInputs& e) {
       drift(e);
       e.heater.probed = true;
     }},
    {Fault::power_limit_exceeded, 100, [](ChannelInputs& e) { e.heater.current.value = 0.4945; }},
    {Fault::controller_invalid, 1, [](ChannelInputs& e) { e.axis.demanded_W = std::nan(""); }},
    {Fault::controller_invalid, 120000,
     [](ChannelInputs& e) {
       e.heater.limited = true;
       e.axis.demanded_W = 3.61;
     }},
    {Fault::command_timeout, 251, [](ChannelInputs& e) { e.commands.renewed = false; }},
    {Fault::command_damaged, 10, [](ChannelInputs& e) { e.commands.damaged = true; }},
    {Fault::command_not_allowed, 10, [](ChannelInputs& e) { e.commands.refused = true; }},
};

void check_fault(Fault expected, Fault found) {
  STRCMP_EQUAL(std::string(name(expected)).c_str(), std::string(name(found)).c_str());
}

}  // namespace

TEST_GROUP(ChannelSupervisor){};

TEST(ChannelSupervisor, ReportsNoFaultInNormalOperation) {
  Channel channel;
  for (int i = 0; i < 150000; ++i)
    check_fault(Fault::none, channel.step());
}

TEST(ChannelSupervisor, DetectsEachFaultAtItsTimeAndNotEarlier) {
  for (const InjectedFault& injected : injected_faults) {
    Channel channel;
    for (int i = 0; i < 10; ++i)
      check_fault(Fault::none, channel.step());
    injected.begins(channel.inputs);
    for (int i = 1; i < injected.ticks; ++i)
      check_fault(Fault::none, channel.step());
    check_fault(injected.fault, channel.step());
    CHECK(channel.supervisor.verdict().fault() == injected.fault);
  }
}

// Except when a probe finds no resistance, which has no margin.
TEST(ChannelSupervisor, EachFaultUsesUpItsMargin) {
  for (const InjectedFault& injected : injected_faults) {
    Channel channel;
    channel.step();
    const detectors::Margin before = channel.supervisor.verdict().margin(injected.fault);
    CHECK_COMPARE(before.used(), <, 1.0);
    injected.begins(channel.inputs);
    for (int i = 0; i < injected.ticks; ++i)
      channel.step();
    const detectors::Margin full = channel.supervisor.verdict().margin(injected.fault);
    if (channel.inputs.heater.probe_failed) continue;
    CHECK_COMPARE(full.used(), >=, 0.99);
  }
}

TEST(ChannelSupervisor, HasNoMarginsForBoardFaults) {
  Channel channel;
  channel.step();
  const Verdict& verdict = channel.supervisor.verdict();
  CHECK_FALSE(verdict.judges(Fault::under_voltage));
  DOUBLES_EQUAL(0.0, verdict.margin(Fault::under_voltage).used(), 0.0);
}

TEST(ChannelSupervisor, ClearsAFaultWhoseCauseIsGone) {
  for (const InjectedFault& injected : injected_faults) {
    // An exceeded energy budget stays exceeded; the return from a jump is another jump.
    if (injected.fault == Fault::energy_budget_exceeded || injected.fault == Fault::sensor_jump)
      continue;
    Channel channel;
    channel.step();
    const ChannelInputs well = channel.inputs;
    injected.begins(channel.inputs);
    for (int i = 0; i < injected.ticks; ++i)
      channel.step();
    channel.inputs = well;
    check_fault(Fault::none, channel.step());
  }
}

TEST(ChannelSupervisor, DetectsASensorWithoutNoiseWhileTheMuscleIsHot) {
  for (const bool hot : {false, true}) {
    Channel channel;
    channel.inputs.heater.hot = hot;
    for (int i = 0; i < 10; ++i)
      check_fault(Fault::none, channel.step());
    channel.sensor_lives = false;
    int quiet = 0;
    while (quiet < 1100 && channel.step() == Fault::none)
      ++quiet;
    LONGS_EQUAL(hot ? 999 : 1100, quiet);
    DOUBLES_EQUAL(hot ? 1.0 : 0.0, channel.supervisor.verdict().margin(Fault::sensor_frozen).used(),
                  0.01);
  }
}

TEST(ChannelSupervisor, CannotDetectAFrozenSensorWithoutConfiguredNoise) {
  ChannelSupervision quiet;
  quiet.position_noise_rms_m = 0.0;
  ChannelSupervisor supervisor(quiet, 10.0, 10.8, 0.0, tick_s);
  const ChannelInputs inputs = Channel().inputs;
  for (int i = 0; i < 2000; ++i)
    check_fault(Fault::none, supervisor.step(inputs.axis, inputs.heater, inputs.commands));
}

TEST(ChannelSupervisor, AStaleReadingIsNotAJump) {
  Channel channel;
  channel.step();
  channel.inputs.axis.sensor_m = 0.0108;
  channel.inputs.axis.position_elapsed_s = 0.0;
  for (int i = 0; i < 10; ++i)
    check_fault(Fault::none, channel.step());
}

TEST(ChannelSupervisor, WithoutAKnownSupplyNoCurrentIsAShort) {
  Channel channel;
  channel.inputs.heater.supply_V = 0.0;
  channel.inputs.heater.current.value = 1.0;
  for (int i = 0; i < 10; ++i)
    check_fault(Fault::none, channel.step());
}

TEST(ChannelSupervisor, WithoutAReadingOfTheCurrentNeitherHeaterNorMuscleIsJudged) {
  Channel channel;
  channel.step();
  channel.inputs.heater.current = {0.0, 0.0, false, hal::Status::not_ready};
  channel.inputs.axis.position.value += 0.002;
  channel.step();
  DOUBLES_EQUAL(0.3, channel.supervisor.verdict().margin(Fault::heater_open).measured, 0.0);
  DOUBLES_EQUAL(0.0, channel.moved_m(), 50e-6);
}

TEST(ChannelSupervisor, ResistanceDriftNeedsMeasurementsWithoutAGap) {
  Channel channel;
  channel.inputs.heater.resistance_Ohm = 15.0;
  for (int i = 1; i < 1500; ++i) {
    channel.inputs.heater.resistance_fresh = i % 499 != 0;
    check_fault(Fault::none, channel.step());
  }
}

TEST(ChannelSupervisor, CountsWrongCommandsUntilOneIsObeyedHoweverRare) {
  for (const Fault fault : {Fault::command_damaged, Fault::command_not_allowed}) {
    Channel channel;
    ChannelInputs& e = channel.inputs;
    bool& wrong = fault == Fault::command_damaged ? e.commands.damaged : e.commands.refused;
    e.commands.obeyed = false;
    for (int i = 1; i <= 10; ++i) {
      wrong = false;
      check_fault(Fault::none, channel.step());
      wrong = true;
      check_fault(i < 10 ? Fault::none : fault, channel.step());
    }
  }
}

TEST(ChannelSupervisor, CoolingIsNotALostController) {
  Channel channel;
  channel.inputs.heater.limited = true;
  channel.inputs.axis.demanded_W = -5.0;
  for (int i = 0; i < 130000; ++i)
    check_fault(Fault::none, channel.step());
}

TEST(ChannelSupervisor, AControllerIsNotLostWithoutAHeatingCommand) {
  Channel channel;
  channel.inputs.heater.limited = true;
  channel.inputs.axis.demanded_W = 5.0;
  channel.inputs.commands.heating = false;
  for (int i = 0; i < 130000; ++i)
    check_fault(Fault::none, channel.step());
}

namespace {

/// The fault within two seconds of a joint's muscle that demands more than it gets and is still.
Fault fault_of_a_motionless_muscle(const std::function<void(ChannelInputs&, int)>& at_tick) {
  Channel channel;
  channel.inputs.axis.in_joint = true;
  channel.inputs.heater.limited = true;
  channel.inputs.axis.demanded_W = 3.7;
  Fault found = Fault::none;
  for (int i = 0; i < 2000 && found == Fault::none; ++i) {
    for (double& expected_m : channel.inputs.heater.expected_m)
      expected_m += 4e-6;
    at_tick(channel.inputs, i);
    found = channel.step();
  }
  return found;
}

}  // namespace

/// For a joint's muscle whose heat changes but which moves nothing. Where there is a minimum power,
/// less may be asked for than it gets.
TEST(ChannelSupervisor, OnlyAMuscleWithUnmetDemandIsLoose) {
  for (const double demanded_W : {3.5, 3.7}) {
    check_fault(demanded_W > 3.6 ? Fault::muscle_loose : Fault::none,
                fault_of_a_motionless_muscle(
                    [&](ChannelInputs& e, int) { e.axis.demanded_W = demanded_W; }));
  }
}

TEST(ChannelSupervisor, AMuscleThatIsOffIsNotLoose) {
  check_fault(Fault::none, fault_of_a_motionless_muscle([](ChannelInputs& e, int) {
                e.heater.off = true;
                e.heater.current.value = 0.0;
              }));
}

// Positions from before say nothing about how far it has moved since.
TEST(ChannelSupervisor, LooseRestartsAfterACalibrationAndWithANewMuscle) {
  constexpr int every = 700;  // less than the 750 within which it must be seen to move
  check_fault(Fault::none, fault_of_a_motionless_muscle([](ChannelInputs& e, int tick) {
                e.axis.recalibrated.reset();
                const double here_m = e.axis.position.value;
                if (tick % every == 0) e.axis.recalibrated = {here_m, here_m, 1.0};
              }));
  check_fault(Fault::none, fault_of_a_motionless_muscle([](ChannelInputs& e, int tick) {
                e.axis.expected_jumped = tick % every == 0;
              }));
}

TEST(ChannelSupervisor, AnExpiredCommandDoesNotConcernARestingMuscle) {
  Channel channel;
  channel.inputs.commands.heating = false;
  channel.inputs.commands.renewed = false;
  for (int i = 0; i < 1000; ++i)
    check_fault(Fault::none, channel.step());
}

TEST(ChannelSupervisor, ARecalibrationIsNotAResponseOfTheMuscle) {
  for (const bool reported : {false, true}) {
    Channel channel;
    for (int i = 0; i < 1000; ++i)
      channel.step();
    const double before_m = channel.inputs.axis.position.value;
    channel.inputs.axis.position.value += 0.002;
    if (reported) channel.inputs.axis.recalibrated = {before_m, before_m + 0.002, 1.0};
    check_fault(Fault::none, channel.step());
    DOUBLES_EQUAL(reported ? 0.0 : 0.002, channel.moved_m(), 50e-6);
  }
}

/// Otherwise the window would never be judged.
TEST(ChannelSupervisor, ARecalibrationKeepsTheMotionOfTheWindow) {
  for (const double ratio : {1.0, 2.0, -1.0}) {
    Channel channel;
    channel.step();
    double& position_m = channel.inputs.axis.position.value;
    position_m += 0.0005;
    channel.step();
    channel.inputs.axis.recalibrated = {position_m, 0.003, ratio};
    position_m = 0.003;
    channel.step();
    channel.inputs.axis.recalibrated.reset();
    DOUBLES_EQUAL(std::abs(ratio) * 0.0005, channel.moved_m(), 10e-6);
    // Back to its previous position.
    position_m = 0.003 - ratio * 0.0005;
    channel.step();
    DOUBLES_EQUAL(std::abs(ratio) * 0.0005, channel.moved_m(), 10e-6);
    // A different muscle is expected: the window starts again.
    channel.inputs.axis.expected_jumped = true;
    channel.step();
    DOUBLES_EQUAL(0.0, channel.moved_m(), 10e-6);
  }
}
