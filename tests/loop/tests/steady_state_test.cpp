// A thermometer that a person reads while the muscle is in steady heat, and a mass that was
// weighed.
#include <optional>

#include <CppUTest/TestHarness.h>

#include "loop/support/axis_case.hpp"

using namespace supercoil;

TEST_GROUP_BASE(SteadyHeatRead, test::AxisCase){
    TEST_SETUP(){settings.firmware.channels[0].senses.error_ratio = 0.02;
}
Refusal read(double rise_K) {
  return rig().answer_to(Verb::compare_rise, rise_K);
}
void check(Refusal expected, Refusal refusal) {
  STRCMP_EQUAL(std::string(name(expected)).c_str(), std::string(name(refusal)).c_str());
}
double true_rise_K() {
  return rig().muscle().plant().temperature_rise_K();
}
double width_K() {
  return rig().snapshot().hottest_C - rig().snapshot().coldest_C;
}
std::optional<board::Learned> update() {
  board::LearnedUpdate update;
  rig().loop.channel(0).take_learned_update(update);
  return update;
}
}
;

TEST(SteadyHeatRead, NarrowsTheIntervalAndIsStored) {
  rig().hold_power(1.5, 24.0);
  const double wide_K = width_K();
  check(Refusal::none, read(true_rise_K() + 0.9));
  const auto kept = update();
  CHECK(kept.has_value());
  CHECK(kept->heat.has_reading());
  CHECK_FALSE(kept->has_muscle);
  rig().hold_power(1.5, 20.0);
  CHECK_COMPARE(width_K(), <, 0.25 * wide_K);
  for (const double power_W : {4.0, 0.3, 2.0, 0.0}) {
    rig().hold_power(power_W, 8.0);
    CHECK_FALSE(rig().interval_missed);
  }
  CHECK(rig().fault() == Fault::none);

  // And at the next start.
  settings.firmware.channels[0].heat = kept->heat;
  rig_.reset();
  rig().hold_power(1.5, 30.0);
  CHECK_COMPARE(width_K(), <, 0.25 * wide_K);
  CHECK_FALSE(rig().interval_missed);
}

/// The reading was taken with the senses as they were corrected at that time.
TEST(SteadyHeatRead, IsForgottenWhenTheSensesAreComparedAgain) {
  rig().hold_power(1.5, 24.0);
  check(Refusal::none, read(true_rise_K()));
  CHECK(update()->heat.has_reading());
  for (const double power_W : {0.5, 1.0}) {
    rig().hold_power(power_W, 2.5);
    const double meter_A = rig().muscle().true_power_W() / 12.0;
    check(Refusal::none, rig().answer_to(Verb::compare_supply, 12.0));
    check(Refusal::none, rig().answer_to(Verb::compare_current, meter_A));
  }
  const auto kept = update();
  CHECK(kept.has_value());
  CHECK(kept->senses.compared());
  CHECK_FALSE(kept->heat.has_reading());
}

/// The reading was taken at a power that compared senses reported.
TEST(SteadyHeatRead, NarrowsNothingWithUncomparedSenses) {
  settings.firmware.channels[0].senses = {};
  const auto hottest_C = [&](const board::ThermalFacts& heat) {
    settings.firmware.channels[0].heat = heat;
    rig_.reset();
    rig().hold_power(1.5, 10.0);
    return rig().snapshot().hottest_C;
  };
  board::ThermalFacts read;
  read.steady_rise_K = 10.0;
  read.steady_error_K = 1.0;
  read.steady_min_W = 1.45;
  read.steady_max_W = 1.55;
  DOUBLES_EQUAL(hottest_C({}), hottest_C(read), 0.5);
}

TEST(SteadyHeatRead, IsRefusedUnlessTheMuscleIsInSteadyHeat) {
  check(Refusal::wrong_state, read(20.0));
  rig().hold_power(1.0, 24.0);
  rig().hold_power(1.5, 20.0);
  check(Refusal::not_ready, read(true_rise_K()));
  rig().hold_power(1.5, 4.0);
  check(Refusal::out_of_range, read(3.0 * true_rise_K()));
  check(Refusal::wrong_state, read(0.0));
  const double wide_K = width_K();
  rig().hold_power(1.5, 5.0);
  DOUBLES_EQUAL(wide_K, width_K(), 0.2);
  CHECK_FALSE(update().has_value());
}

TEST(SteadyHeatRead, NeedsComparedSenses) {
  settings.firmware.channels[0].senses = {};
  rig().hold_power(1.5, 26.0);
  check(Refusal::not_ready, read(true_rise_K()));
}

TEST(SteadyHeatRead, IsForgottenOnRequestAndWithTheSenseComparison) {
  for (const Verb verb : {Verb::compare_rise, Verb::compare_supply, Verb::store}) {
    rig_.reset();
    rig().hold_power(1.5, 24.0);
    const double wide_K = width_K();
    check(Refusal::none, read(true_rise_K()));
    rig().hold_power(1.5, 10.0);
    CHECK_COMPARE(width_K(), <, 0.25 * wide_K);
    rig().send(Verb::rest);
    rig().run(0.1);
    rig().send(verb, 0.0);
    rig().run(0.1);
    rig().hold_power(1.5, 25.0);
    CHECK_COMPARE(width_K(), >, 0.95 * wide_K);
    CHECK_FALSE(rig().interval_missed);
  }
}

TEST(SteadyHeatRead, AWeighedMassAndIdentifyGiveTheHeatTransfer) {
  for (const bool weighed : {false, true}) {
    settings.firmware.channels[0].thermal.mass_error_ratio = weighed ? 0.03 : 0.0;
    rig_.reset();
    rig().heat(test::Task::identify);
    rig().run(61.0);
    CHECK(rig().state() == State::armed);
    // Whatever identify itself says of the muscle.
    const auto found = update();
    CHECK((found.has_value() && found->heat.has_time_constant()) == weighed);
    if (weighed) DOUBLES_EQUAL(0.162 / 0.089, found->heat.time_constant_s, 0.03);
    rig().task = test::Task::nothing;
    rig().hold_power(1.5, 25.0);
    const double max_K = 1.04 * 1.5 / 0.089 * 1.25 / 0.97;
    CHECK((rig().snapshot().hottest_C - 25.0 < max_K + 1.0) == weighed);
    CHECK_FALSE(rig().interval_missed);
  }
}
