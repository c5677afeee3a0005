// What an axis is commanded, and what it publishes.
#include <cmath>
#include <optional>
#include <utility>

#include <CppUTest/TestHarness.h>

#include "loop/support/axis_case.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP_BASE(Axis, AxisCase){};

TEST(Axis, ReportsFrictionWhenLessThanHalfOfASmallMotionArrives) {
  for (const double ratio : {0.0, 0.3, 0.7, 1.2}) {
    settings.firmware.channels[0].response_ratio = ratio;
    Rig each(settings);
    each.run_ticks(2);
    CHECK_EQUAL(ratio == 0.3, (each.snapshot().identify_notes & note_friction) != 0);
  }
}

/// With what a dither may take away, too.
TEST(Axis, CountsOnNoPowerWhereDeratingLeavesNone) {
  ChannelSettings& channel = settings.firmware.channels[0];
  channel.muscle_identified = true;
  channel.limiter.derate_from_C = 1.0;
  channel.limiter.derate_to_C = 2.0;
  Rig hot(settings);
  hot.run_ticks(2);
  DOUBLES_EQUAL(0.0, hot.loop.channel(0).axis().opposition(1.0, 1.0).held_W, 0.0);
}

/// At once, not only at the next start. The muscle was believed to move half as far again.
TEST(Axis, ExpectsTheMotionOfTheIdentifiedMuscle) {
  control::ThermalBounds& bounds = settings.firmware.channels[0].thermal.bounds;
  const control::PhysicalParameters& plant = settings.board.channels[0].plant;
  bounds.min_mass_J_per_K = bounds.max_mass_J_per_K = plant.thermal_mass_J_per_K;
  bounds.min_transfer_W_per_K = bounds.max_transfer_W_per_K = plant.heat_transfer_W_per_K;
  settings.firmware.channels[0].muscle.force_per_kelvin_N_per_K *= 1.5;
  rig().heat(Task::identify);
  CHECK(rig().run_until([&] { return rig().state() == State::armed; }, 200.0));
  CHECK(rig().snapshot().result == ModeResult::found);
  rig().task = Task::nothing;
  rig().run(30.0);
  const auto margin = [&] {
    return rig().loop.channel(0).verdict().margin(Fault::heater_not_responding);
  };
  for (int i = 0; i < 30 && margin().measured < 0.004; ++i)
    rig().hold_power(2.0, 1.0);
  rig().run(2.0);  // the motion catches up with the heat
  CHECK(margin().judged);
  DOUBLES_EQUAL(0.3, margin().limit / margin().measured, 0.03);
}

TEST(Axis, RestsWhenDisarmed) {
  rig().heat(Task::position);
  rig().run(1.0);
  CHECK(rig().snapshot().mode == Mode::position);
  CHECK(rig().snapshot().reference > 0.0);
  rig().task = Task::nothing;
  CHECK(answer_to(Verb::disarm) == Refusal::none);
  CHECK(rig().snapshot().mode == Mode::rest);
  DOUBLES_EQUAL(0.0, rig().snapshot().reference, 0.0);
}

TEST(Axis, ReportsAModeAsRunningThenInterrupted) {
  for (const auto& [task, mode] :
       {std::pair{Task::identify, Mode::identify}, std::pair{Task::calibrate, Mode::calibrate}}) {
    rig().heat(task);
    rig().run(0.5);
    CHECK(rig().snapshot().mode == mode);
    CHECK(rig().snapshot().result == ModeResult::running);
    DOUBLES_EQUAL(0.0, rig().snapshot().reference, 0.0);
    rig().task = Task::nothing;
    CHECK(answer_to(Verb::rest) == Refusal::none);
    CHECK(rig().snapshot().mode == Mode::rest);
    CHECK(rig().snapshot().result == ModeResult::interrupted);
  }
}

TEST(Axis, UsesTheSelectedController) {
  LONGS_EQUAL(0, rig().snapshot().controller);
  CHECK(answer_to(Verb::controller, 2.0) == Refusal::none);
  LONGS_EQUAL(2, rig().snapshot().controller);
  rig().heat(Task::position);
  CHECK(answer_to(Verb::controller, 1.0) == Refusal::none);
  LONGS_EQUAL(1, rig().snapshot().controller);
  CHECK(answer_to(Verb::controller, 3.0) == Refusal::out_of_range);
  LONGS_EQUAL(1, rig().snapshot().controller);
}

/// mrac would forget what it has learned of this muscle.
TEST(Axis, ChoosingTheControllerInUseChangesNothing) {
  const auto gain = [&] {
    CHECK(rig().run_until([&] { return rig().snapshot().gain.gain == control::Gain::position; },
                          1.0));
    return rig().snapshot().gain.value;
  };
  CHECK(answer_to(Verb::controller, 2.0) == Refusal::none);
  rig().heat(Task::position);
  rig().run(0.1);
  const double first = gain();
  rig().run(20.0);
  const double learned = gain();
  CHECK_COMPARE(std::abs(learned - first), >, 0.01);
  CHECK(answer_to(Verb::controller, 2.0) == Refusal::none);
  DOUBLES_EQUAL(learned, gain(), 0.1 * std::abs(learned - first));
}

TEST(Axis, NamesAWholeNumberAsTheNearestPlace) {
  for (const auto& [place, nearest] :
       {std::pair{1.6, 2.0}, std::pair{0.4, 0.0}, std::pair{2.4, 2.0}, std::pair{-3.0, 0.0}}) {
    for (const Verb verb : {Verb::controller, Verb::estimator}) {
      CHECK(answer_to(verb, place) == Refusal::out_of_range);
      if (verb == Verb::controller) DOUBLES_EQUAL(nearest, rig().last_nearest, 0.0);
      DOUBLES_EQUAL(std::floor(rig().last_nearest), rig().last_nearest, 0.0);
    }
  }
}

TEST(Axis, RefusesInvalidTuningSlots) {
  for (const double place : {-1.0, 256.0, std::nan("")})
    CHECK(answer_to(Verb::tune, place) == Refusal::out_of_range);
  CHECK(answer_to(Verb::tune, 0.0) == Refusal::none);
}

TEST(Axis, StartsWithTheStoredController) {
  for (const auto& [stored, chosen] : {std::pair{1.0, 1}, std::pair{2.0, 2}, std::pair{3.0, 0}}) {
    settings.firmware.channels[0].tuning.controller = stored;
    Rig each(settings);
    each.run_ticks(1);
    LONGS_EQUAL(chosen, each.snapshot().controller);
  }
}

TEST(Axis, ClearingTheMuscleClearsTheSteadyHeatReading) {
  ChannelSettings& channel = settings.firmware.channels[0];
  channel.senses.error_ratio = 0.02;
  channel.heat = {0.0, 0.0, 1.5 / 0.089, 1.0, 1.5, 1.5};
  const auto width_K = [&] { return rig().snapshot().hottest_C - rig().snapshot().coldest_C; };
  rig().hold_power(1.5, 25.0);
  const double narrow_K = width_K();
  CHECK(answer_to(Verb::store, 0.0) == Refusal::none);
  CHECK_FALSE(update().has_value());
  rig().hold_power(1.5, 10.0);
  CHECK_COMPARE(width_K(), >, 3.0 * narrow_K);
  CHECK_FALSE(rig().interval_missed);
}

/// The power from before the rest must not be carried over.
TEST(Axis, SwitchesControllersRightAfterStartWithoutAJump) {
  rig().heat(Task::position);
  rig().run(10.0);
  rig().task = Task::nothing;
  CHECK(answer_to(Verb::rest) == Refusal::none);
  rig().run(5.0);
  CHECK(answer_to(Verb::position, 0.010) == Refusal::none);
  for (int i = 0; i < 3; ++i)
    CHECK(answer_to(Verb::position, 0.010) == Refusal::none);
  const double before_W = rig().snapshot().demanded_W;
  CHECK(answer_to(Verb::controller, 1.0) == Refusal::none);
  DOUBLES_EQUAL(before_W, rig().snapshot().demanded_W, 0.3);
}

TEST(Axis, StoresASteadyHeatReadingWithTheMeasuredPower) {
  settings.firmware.channels[0].senses.error_ratio = 0.02;
  rig().hold_power(1.5, 24.0);
  CHECK(answer_to(Verb::compare_rise, rig().muscle().plant().temperature_rise_K()) ==
        Refusal::none);
  const auto read = update();
  DOUBLES_EQUAL(1.5, read->heat.steady_min_W, 0.04);
  DOUBLES_EQUAL(1.5, read->heat.steady_max_W, 0.04);
}

/// The time constant is that of the heat, whatever else identify finds.
TEST(Axis, KeepsTheTimeConstantOfAnImplausibleMuscle) {
  ChannelSettings& channel = settings.firmware.channels[0];
  channel.muscle.stiffness_N_per_m = 200.0;
  channel.thermal.mass_error_ratio = 0.03;
  channel.heater.temperature_coefficient_per_K = 0.0;  // otherwise the temperatures disagree
  rig().heat(Task::identify);
  rig().run(61.0);
  CHECK(rig().snapshot().result == ModeResult::implausible);
  const auto found = update();
  CHECK_FALSE(found->has_muscle);
  DOUBLES_EQUAL(0.162 / 0.089, found->heat.time_constant_s, 0.05);
}

/// Otherwise a muscle that hangs loose would look as if it had moved.
TEST(Axis, ANewZeroDoesNotCountAsMotion) {
  settings.firmware.channels[0].supervision.proof_of_response = false;
  settings.firmware.channels[0].heater.temperature_coefficient_per_K = 0.0;
  for (const double waited_s : {0.0, 4.0, 8.0, 12.0}) {
    rig_.emplace(settings);
    rig().muscle().position.set({.offset = 0.003});
    rig().boot();
    rig().arm();
    rig().run(0.2 + waited_s);
    rig().heat(Task::calibrate);
    CHECK(rig().run_until([&] { return rig().state() == State::armed; }, 60.0));
    DOUBLES_EQUAL(0.003, update()->calibration.position_offset_m, 1e-4);
    rig().run(0.1);
    rig().muscle().faults.slack = true;
    rig().heat(Task::power);
    // Found within the window in which it began to heat, or in the next if that one was at its end.
    CHECK(rig().run_until([&] { return rig().fault() != Fault::none; }, 21.5));
    CHECK(rig().fault() == Fault::heater_not_responding);
  }
}

/// identify does not wait for dithers that the sensor's noise would hide.
TEST(Axis, SkipsSmallMotionsThatNoiseWouldHide) {
  settings.firmware.channels[0].response_ratio = 0.3;  // of an earlier muscle
  const auto identified_s = [&](double noise_rms_m) {
    settings.firmware.channels[0].supervision.position_noise_rms_m = noise_rms_m;
    settings.board.channels[0].position.noise_rms = noise_rms_m;
    rig_.reset();
    rig().heat(Task::identify);
    const double begun_s = rig().time_s();
    CHECK(rig().run_until([&] { return rig().state() == State::armed; }, 90.0));
    CHECK(rig().snapshot().result == ModeResult::found);
    const bool measured = update()->response_ratio > 0.0;
    CHECK_EQUAL(noise_rms_m < 1e-4, measured);
    return rig().time_s() - begun_s;
  };
  // Five time constants to come to rest, and four seconds at least.
  CHECK_COMPARE(identified_s(10e-6) - identified_s(500e-6), >, 5.0 * 0.162 / 0.089 + 3.0);
}

/// Bounds that let a muscle cool faster than it does make it seem colder than it is.
TEST(Axis, SlowCoolingRaisesTheHottestTemperature) {
  ChannelSettings& channel = settings.firmware.channels[0];
  channel.thermal.bounds.min_transfer_W_per_K = 0.100;  // the muscle has 0.089
  channel.heater.temperature_coefficient_per_K = 0.0;   // otherwise the temperatures disagree
  channel.estimators[0].kind = control::EstimatorKind::least_squares;
  channel.estimators[0].set_nominal(channel.muscle, channel.limiter.max_W);
  const auto rise_K = [&](double trusted_error) {
    channel.estimators[0].excitation.trusted_error = trusted_error;
    rig_.reset();
    rig().heat(Task::power);
    rig().run(15.0);
    rig().task = Task::nothing;
    rig().hold_power(2.0, 15.0);
    CHECK(rig().fault() == Fault::none);
    CHECK_EQUAL(trusted_error > 0.0, rig().snapshot().trusted);
    return rig().snapshot().hottest_C - channel.thermal.air.warmest_C;
  };
  DOUBLES_EQUAL(0.100 / 0.089, rise_K(100.0) / rise_K(0.0), 0.03);
}

/// Otherwise a muscle that hangs loose would look as if it had moved.
TEST(Axis, ANewScaleDoesNotCountAsMotion) {
  settings.firmware.channels[0].supervision.proof_of_response = false;
  for (const double waited_s : {1.0, 5.0, 9.0, 13.0}) {
    rig_.reset();
    rig().heat(Task::power);
    rig().run(8.0 + waited_s);
    rig().muscle().faults.slack = true;
    const double before_m = moved_m();
    rig().send(Verb::scale, 1.3 * rig().snapshot().position_m);
    rig().tick();
    CHECK(update()->has_muscle);
    rig().run_ticks(2);
    DOUBLES_EQUAL(1.3 * before_m, moved_m(), 1e-4);
    // This window still contains the muscle's own motion: found in the next one at the latest.
    CHECK(rig().run_until([&] { return rig().fault() != Fault::none; }, 40.0));
    CHECK(rig().fault() == Fault::heater_not_responding);
  }
}

TEST(Axis, TwoScalesInOneTickDoNotCountAsMotion) {
  rig().heat(Task::power);
  rig().run(10.0);
  const double before_m = moved_m();
  const double position_m = rig().snapshot().position_m;
  CHECK_COMPARE(before_m, >, 0.002);
  rig().send(Verb::scale, 1.5 * position_m);
  rig().send(Verb::scale, 1.2 * position_m);
  rig().run_ticks(2);
  DOUBLES_EQUAL(1.2 * position_m, rig().snapshot().position_m, 1e-4);
  DOUBLES_EQUAL(1.2 * before_m, moved_m(), 1e-4);
}

/// While a muscle rests it cools and its estimator is paused: that change of position is no motion.
TEST(Axis, EstimatorRestartsCleanlyOnACooledMuscle) {
  const auto follow = [this](double position_m, double time_s) {
    CHECK_FALSE(rig().run_until(
        [&] {
          rig().send(Verb::position, position_m);
          return rig().state() == State::fault;
        },
        time_s));
  };
  follow(0.010, 20.0);
  const auto before = rig().snapshot().theta;
  CHECK(answer_to(Verb::rest) == Refusal::none);
  rig().run(30.0);
  follow(0.001, 0.5);
  for (Eigen::Index i = 0; i < before.size(); ++i) {
    DOUBLES_EQUAL(before[i], rig().snapshot().theta[i], 0.02 * std::abs(before[i]));
  }
}
