// What an axis stores of its muscle, and keeps.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "loop/support/axis_case.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP_BASE(AxisKnowledge, AxisCase){};

/// And stores it again with whatever else is stored.
TEST(AxisKnowledge, UnexplainedRatioSurvivesARestart) {
  for (const double stored : {0.0, 0.25}) {
    settings.firmware.channels[0].unexplained_ratio = stored;
    rig_.reset();
    const double reported = rig().loop.channel(0).known(known_unexplained_ratio);
    CHECK_TRUE(stored > 0.0 ? reported == stored : std::isnan(reported));
    rig().arm();
    CHECK(answer_to(Verb::scale, 1.1 * rig().snapshot().position_m) == Refusal::none);
    DOUBLES_EQUAL(stored, update()->unexplained_ratio, 0.0);
  }
}

/// And publishes it, until another muscle is stored.
TEST(AxisKnowledge, IdentifyDeviationsSurviveARestart) {
  const board::Identification stored{{0.0, 0.2, 0.1, 0.05}, 1795219200.0};
  settings.firmware.channels[0].identification = stored;
  const Channel& channel = rig().loop.channel(0);
  CHECK_TRUE(std::isnan(channel.known(known_theta1_deviation)));
  DOUBLES_EQUAL(0.05, channel.known(known_theta1_deviation + 3), 0.0);
  DOUBLES_EQUAL(1795219200.0, channel.known(known_identified), 0.0);
  rig().arm();
  CHECK(answer_to(Verb::scale, 1.1 * rig().snapshot().position_m) == Refusal::none);
  CHECK(update()->identification == stored);
}

TEST(AxisKnowledge, LaterUpdatesKeepEarlierResults) {
  rig().hold_power(2.0, 4.0);
  CHECK(answer_to(Verb::scale, 1.1 * rig().snapshot().position_m) == Refusal::none);
  const auto scaled = update();
  CHECK(scaled.has_value() && scaled->has_muscle);
  DOUBLES_EQUAL(1.1, scaled->calibration.position_scale, 0.01);
  // A change of scale is not a sensor jump.
  rig().hold_power(2.0, 3.0);
  CHECK(rig().fault() == Fault::none);
  CHECK(answer_to(Verb::controller, 2.0) == Refusal::none);
  CHECK(answer_to(Verb::store, store_tuning) == Refusal::none);
  const auto stored = update();
  CHECK(stored.has_value() && stored->has_muscle);
  CHECK(stored->calibration == scaled->calibration);
  DOUBLES_EQUAL(2.0, stored->tuning.controller.value_or(-1.0), 0.0);
  DOUBLES_EQUAL(0.0, stored->tuning.estimator.value_or(-1.0), 0.0);
  CHECK(answer_to(Verb::scale, 1.1 * rig().snapshot().position_m) == Refusal::none);
  CHECK(update()->tuning == stored->tuning);
  CHECK(answer_to(Verb::store, clear_tuning) == Refusal::none);
  CHECK(update()->tuning == board::StoredTuning{});
}

TEST(AxisKnowledge, ClearedMuscleIsNotStoredWithTheTuning) {
  rig().hold_power(2.0, 4.0);
  CHECK(answer_to(Verb::scale, 1.1 * rig().snapshot().position_m) == Refusal::none);
  CHECK(update()->has_muscle);
  CHECK(answer_to(Verb::store, 0.0) == Refusal::none);
  CHECK_FALSE(update().has_value());
  CHECK(answer_to(Verb::store, store_tuning) == Refusal::none);
  CHECK_FALSE(update()->has_muscle);
}

/// The usual order for a new muscle: clear, calibrate, identify.
TEST(AxisKnowledge, ClearedMuscleIsNotStoredWithACalibration) {
  ChannelSettings& channel = settings.firmware.channels[0];
  channel.configured_muscle = channel.muscle;
  channel.muscle.stiffness_N_per_m *= 1.1;
  channel.has_muscle = channel.muscle_identified = true;
  channel.response_ratio = 0.9;
  channel.unexplained_ratio = 0.1;
  channel.identification = {{0.1, 0.1, 0.1, 0.1}, 1795219200.0};
  CHECK(answer_to(Verb::store, 0.0) == Refusal::none);
  CHECK_FALSE(update().has_value());
  rig().hold_power(2.0, 4.0);
  CHECK(answer_to(Verb::scale, 1.1 * rig().snapshot().position_m) == Refusal::none);
  const auto stored = update();
  CHECK(stored->muscle == *channel.configured_muscle);
  DOUBLES_EQUAL(0.0, stored->response_ratio, 0.0);
  DOUBLES_EQUAL(0.0, stored->unexplained_ratio, 0.0);
  CHECK(stored->identification == board::Identification{});
  DOUBLES_EQUAL(1.1, stored->calibration.position_scale, 0.01);
}

/// It moves as much further as the scale says; a configured muscle is as it is configured.
TEST(AxisKnowledge, ScaleAlsoScalesAnIdentifiedMuscle) {
  for (const bool identified : {false, true}) {
    ChannelSettings& channel = settings.firmware.channels[0];
    channel.configured_muscle = channel.muscle;
    if (identified) channel.configured_muscle->stiffness_N_per_m *= 1.1;
    rig_.reset();
    rig().hold_power(2.0, 4.0);
    CHECK(answer_to(Verb::scale, 1.2 * rig().snapshot().position_m) == Refusal::none);
    DOUBLES_EQUAL(
        identified ? 1.2 : 1.0,
        update()->muscle.force_per_kelvin_N_per_K / channel.muscle.force_per_kelvin_N_per_K, 0.01);
  }
}

TEST(AxisKnowledge, RefusesAScaleWhileItMeasures) {
  for (const Task task : {Task::identify, Task::calibrate}) {
    rig().heat(task);
    rig().run(0.5);
    CHECK(answer_to(Verb::scale, 0.005) == Refusal::busy);
    rig().task = Task::nothing;
    CHECK(answer_to(Verb::rest) == Refusal::none);
  }
}
