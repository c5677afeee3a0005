#include "loop/heater.hpp"

#include <cmath>
#include <string>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(Heater) {
  RigSettings settings = rough_board();

  static void arm(Rig & rig) {
    rig.boot();
    rig.arm();
    rig.run(0.2);
    CHECK(rig.state() == State::armed);
  }
};

TEST(Heater, ReportsSenseGainsWithoutTheirDate) {
  CHECK(Rig(settings).loop.channel(0).senses() == board::SenseComparison{});
  settings.firmware.channels[0].senses = {1.02, 0.98, 0.03, 1.7e9};
  const board::SenseComparison without_date{1.02, 0.98, 0.03, 0.0};
  CHECK(Rig(settings).loop.channel(0).senses() == without_date);
}

TEST(Heater, FirstTickOverwritesAnyPreviousDuty) {
  Rig rig(settings);
  CHECK(rig.muscle().pwm.set(5) == hal::Status::ok);
  rig.run_ticks(1);
  LONGS_EQUAL(0, rig.muscle().pwm.read_back());
}

TEST(Heater, ReportsTheAgeOfItsResistance) {
  Rig rig(settings);
  arm(rig);
  const double age_s = rig.snapshot().resistance_age_s;
  CHECK_COMPARE(age_s, <, 0.2);
  rig.run(1.0);
  DOUBLES_EQUAL(age_s + 1.0, rig.snapshot().resistance_age_s, 1e-6);
  CHECK(rig.state() == State::armed);
}

TEST(Heater, ADelayedCurrentIsNotAShortWithATwoTickDebounce) {
  // As with a converter on a bus. Probes end with a falling duty, after which no current flows.
  const auto fault_with = [](double short_ticks) {
    RigSettings slow = rough_board(100.0);
    host_sim::MuscleChannelSettings& simulated = slow.board.channels[0];
    ChannelSettings& channel = slow.firmware.channels[0];
    simulated.sense_filter_s = channel.heater.sense_filter_s = 0.010;
    simulated.current.period_s = 0.002;
    simulated.current.latency_s = 0.008;
    channel.heater.current.max_age_s = 0.05;
    channel.supervision.off_current_A = 0.005;
    channel.supervision.short_s = short_ticks * 0.010;
    Rig rig(slow);
    rig.boot();
    rig.arm();
    rig.hold_power(0.02, 30.0);  // below a probe's: it is probed every 5 s
    return rig.fault();
  };
  STRCMP_EQUAL("heater_short", std::string(name(fault_with(1.0))).c_str());
  STRCMP_EQUAL("none", std::string(name(fault_with(2.0))).c_str());
}

/// firmware/io/config/examples/raspberry-pi-pwm-ads1115.toml: 0.67 A are 6.8 mA after 50 ms.
TEST(Heater, SlowSenseAfterFullPowerIsNotStuckOn) {
  RigSettings slow = rough_board(100.0);
  ChannelSettings& channel = slow.firmware.channels[0];
  slow.board.channels[0].sense_filter_s = channel.heater.sense_filter_s = 0.010;
  channel.supervision.off_current_A = 0.005;
  for (const double heated_s : {0.0, 0.02, 0.05, 0.5}) {
    Rig rig(slow);
    arm(rig);
    rig.hold_power(4.5, 0.01 + heated_s);
    CHECK(rig.answer_to(Verb::disarm) == Refusal::none);
    rig.run(1.0);
    STRCMP_EQUAL("none", std::string(name(rig.fault())).c_str());
  }
}

TEST(Heater, AnOldResistanceOfACooledMuscleIsNotJudged) {
  ChannelSettings& channel = settings.firmware.channels[0];
  channel.supervision.resistance_ratio = 0.05;
  channel.heater.probe_every_s = 60.0;
  Rig rig(settings);
  arm(rig);
  rig.hold_power(4.5, 10.0);
  CHECK_COMPARE(rig.snapshot().resistance_Ohm, >, 10.8);
  rig.hold_power(0.0, 14.0);
  CHECK(rig.fault() == Fault::none);
  CHECK_COMPARE(rig.snapshot().resistance_Ohm, >, 10.8);
}

TEST(Heater, AFrozenSensorIsAFaultOnlyIfTheMuscleMayBeWarm) {
  for (const auto& [boot_rise_K, fault] :
       {std::pair{3.0, Fault::none}, std::pair{20.0, Fault::sensor_frozen}}) {
    for (ChannelSettings& channel : settings.firmware.channels)
      channel.thermal.boot_rise_K = boot_rise_K;
    Rig rig(settings);
    rig.run(0.5);
    rig.muscle().position.set({.frozen = true});
    rig.run(1.5);
    CHECK(rig.fault() == fault);
  }
}

/// A duty's rounding error is made up for in the next tick, but not after a rest.
TEST(Heater, RestClearsTheDutyRemainder) {
  settings.board.supply.noise_rms = 0.0;
  settings.board.channels[0].current.noise_rms = 0.0;
  Rig rig(settings);
  arm(rig);
  for (int i = 0; i < 20; ++i) {
    const double power_W = 1.0 + 0.0131 * i;
    rig.send(Verb::power, power_W);
    rig.tick();
    const Snapshot& s = rig.snapshot();
    const double exact = power_W * s.resistance_Ohm / (s.supply_V * s.supply_V) * 4095.0;
    DOUBLES_EQUAL(std::floor(exact + 0.5), s.duty * 4095.0, 1e-6);
    rig.run_ticks(7);
    rig.send(Verb::rest);
    rig.run_ticks(2);
    CHECK(rig.state() == State::armed);
  }
}

TEST(Heater, AFailedEnableLineIsABoardFault) {
  Rig rig(settings);
  rig.boot();
  rig.muscle().enable.refuses = hal::Status::io_error;
  rig.send(Verb::arm);
  rig.run(0.01);
  CHECK(rig.loop.board_fault() == Fault::line_failed);
  CHECK(rig.state() == State::fault);
}

/// As a hot end that was known to be below it once, and is above where derating begins.
TEST(Heater, OverTemperatureDespiteDeratingIsAFault) {
  ChannelSettings& channel = settings.firmware.channels[0];
  channel.thermal.boot_rise_K = 20.0;
  channel.limiter.derate_from_C = 60.0;
  channel.limiter.derate_to_C = 90.0;
  channel.supervision.trip_C = 70.0;
  Rig rig(settings);
  arm(rig);
  CHECK(rig.run_until(
      [&] {
        rig.send(Verb::power, 4.5);
        return rig.state() == State::fault;
      },
      20.0));
  CHECK(rig.fault() == Fault::over_temperature);
}
