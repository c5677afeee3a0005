#include "loop/settings.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(BoardSettingsCheck) {
  BoardSettings settings;
  void check_says(const char* what, const char* key = "") const {
    const auto problem = check(settings);
    CHECK(problem.has_value());
    STRCMP_EQUAL(key, problem->key.c_str());
    STRCMP_CONTAINS(what, problem->message.c_str());
  }
};

TEST(BoardSettingsCheck, DefaultsMayRun) {
  CHECK_FALSE(check(settings).has_value());
}

TEST(BoardSettingsCheck, RefusesAnInvalidBoard) {
  settings.channels.clear();
  check_says("a board has 1 to 16 channels, not 0");
  settings.channels.resize(17);
  check_says("not 17");
  settings.channels.resize(16);
  CHECK_FALSE(check(settings).has_value());
  settings.channels[3].controllers.clear();
  check_says("needs a controller");
  settings.channels[3].controllers.resize(1);
  settings.channels[3].estimators.clear();
  check_says("and an estimator");
}

TEST(BoardSettingsCheck, RefusesAPumpThatALateTickWouldStop) {
  settings.supervision.overruns_in_a_row = 10;
  settings.supervision.charge_pump_decay_s = 0.0201;
  CHECK_FALSE(check(settings).has_value());
  settings.supervision.charge_pump_decay_s = 0.0199;
  check_says("10 in a row at 1000 Hz are 10 ms, so more than 20 ms, not 19.9",
             "charge_pump_decay_ms");
}

TEST(BoardSettingsCheck, AJointTakesTwoChannelsOfTheBoard) {
  settings.channels.resize(4);
  for (ChannelSettings& channel : settings.channels)
    channel.supervision.proof_of_response = false;
  settings.joints = {{.agonist = 2, .antagonist = 1}};
  CHECK_FALSE(check(settings).has_value());
  for (const std::size_t channel : {1U, 2U})
    POINTERS_EQUAL(&settings.joints[0], settings.joint_of(channel));
  for (const std::size_t channel : {0U, 3U})
    POINTERS_EQUAL(nullptr, settings.joint_of(channel));

  settings.joints[0].antagonist = 4;
  check_says("channel 5 is not one of the board's 4", "joint");
  settings.joints[0].agonist = 5;
  check_says("channel 6 is not one of the board's 4", "joint");
  settings.joints[0].agonist = 2;
  settings.joints[0].antagonist = 2;
  check_says("channel 3 is used twice", "joint");
  settings.joints = {{.agonist = 0, .antagonist = 1}, {.agonist = 2, .antagonist = 1}};
  check_says("channel 2 is used twice", "joint");
  settings.joints.resize(1);
  settings.channels[1].supervision.proof_of_response = true;
  check_says("channel 2 cannot prove by itself that it responds", "joint");
  settings.channels[1].supervision.proof_of_response = false;
  settings.joints[0].co_contraction_W = -0.1;
  check_says("co_contraction_W be 0 or more", "joint");
  settings.joints[0].co_contraction_W = 2.1;
  settings.joints[0].max_co_contraction_W = 2.0;
  check_says("must not exceed max_co_contraction_W", "joint");
}

TEST(BoardSettingsCheck, OnlyTheLeaderOfABundleMayHaveAProofOfResponse) {
  settings.channels.resize(3);
  add_bundle(settings, {{0, 2}});
  CHECK_FALSE(check(settings).has_value());
  for (const std::size_t channel : {0U, 2U})
    POINTERS_EQUAL(&settings.bundles[0], settings.bundle_of(channel));
  POINTERS_EQUAL(nullptr, settings.bundle_of(1));
  settings.channels[2].supervision.proof_of_response = true;
  check_says("channel 3 cannot prove by itself that it responds", "bundle");
  settings.bundles[0].channels = {0};
  check_says("channels must be at least two", "bundle");
}

TEST(BoardSettingsCheck, AControllerThatContradictsItselfIsNamed) {
  control::ControllerSettings controller;
  controller.kind = control::ControllerKind::learned_ff;
  CHECK(contradictions(controller).empty());
  controller.arithmetic = control::Arithmetic::q8_24;
  controller.learned_ff.period_s = 1.0;
  controller.learned_ff.find_period = true;
  controller.learned_ff.bandwidth_rad_per_s = 0.0;
  LONGS_EQUAL(4, contradictions(controller).size());
  controller = {};
  CHECK(contradictions(controller).empty());
  controller.model = control::design_model();
  STRCMP_CONTAINS("Eq. (12)", contradictions(controller).back().message.c_str());
  controller.mrac.accept_failed_premises = true;
  CHECK(contradictions(controller).empty());
}

TEST(BoardSettingsCheck, AnUnknownEstimatorKindIsNamed) {
  control::EstimatorSettings estimator;
  CHECK(contradictions(estimator).empty());
  for (const std::size_t none : {control::estimator_names.size(), std::size_t{200}}) {
    estimator.kind = static_cast<control::EstimatorKind>(none);
    const auto problem = check(estimator, settings.channels[0], 1e-3);
    CHECK(problem.has_value());
    STRCMP_EQUAL("kind", problem->key.c_str());
  }
}

TEST(BoardSettingsCheck, FixedPointRangeDependsOnTravelPowerAndStep) {
  ChannelSettings channel;
  control::ControllerSettings controller;
  controller.arithmetic = control::Arithmetic::q8_24;
  controller.kind = control::ControllerKind::pi;
  CHECK_FALSE(check(controller, channel, 1e-3).has_value());
  channel.supervision.max_travel_m = 10.0;
  STRCMP_EQUAL("arithmetic", check(controller, channel, 1e-3)->key.c_str());
  channel = {};
  channel.limiter.max_W = 200.0;
  STRCMP_EQUAL("arithmetic", check(controller, channel, 1e-3)->key.c_str());
  channel = {};
  controller.kind = control::ControllerKind::mrac;
  CHECK_FALSE(check(controller, channel, 1e-3).has_value());
  STRCMP_EQUAL("gain", check(controller, channel, 1e-12)->key.c_str());
}

/// From any law and model, with any values changed at run time.
TEST(BoardSettingsCheck, StoredTuningRestoresTheSameController) {
  const auto with = [](std::size_t kind, double model, double factor) {
    control::ControllerSettings c;
    for (std::size_t i = 0; i < control::tunable_count; ++i) {
      const control::Tunable& t = control::tunables()[i];
      const double value = t.get(c);
      if (t.type == control::TunableType::kind) {
        t.set(c, static_cast<double>(kind));
      } else if (t.type == control::TunableType::model && !std::isnan(value)) {
        t.set(c, model);
        if (model == 0.0) c.model = control::poles_model({2.0, 3.0, 4.0});
      } else if (!std::isnan(value) && t.in_range(factor * value)) {
        t.set(c, factor * value);
      }
    }
    return c;
  };
  const std::size_t kinds = control::controller_names.size();
  for (std::size_t one = 0; one < kinds * 4; ++one) {
    for (std::size_t other = 0; other < kinds * 4; ++other) {
      for (const double factor : {0.25, 1.0}) {
        const std::size_t one_model = one / kinds;
        const std::size_t other_model = other / kinds;
        const auto configured = with(one % kinds, static_cast<double>(one_model), 1.0);
        const auto now = with(other % kinds, static_cast<double>(other_model), factor);
        auto again = configured;
        board::StoredValues::difference(now, configured).apply_to(again);
        for (const control::Tunable& t : control::tunables()) {
          const double wanted = t.get(now);
          const double got = t.get(again);
          CHECK_TEXT(got == wanted || (std::isnan(got) && std::isnan(wanted)), t.name.data());
        }
      }
    }
  }
}

TEST(BoardSettingsCheck, StoredTuningThatIsUnstableIsDroppedAndNamed) {
  ChannelSettings channel;
  channel.controllers[0].kind = control::ControllerKind::pi;
  board::Learned learned;
  learned.has_muscle = false;
  auto& integral =
      learned.tuning.controllers[0].values[control::tunable_named("integral_W_per_m_s")];
  integral = 800.0;
  apply_learned(channel, learned);
  CHECK_FALSE(drop_unusable_tuning(channel, 1e-3).has_value());
  DOUBLES_EQUAL(800.0, channel.controllers[0].pi.integral_W_per_m_s, 0.0);
  channel.controllers = channel.configured_controllers;
  integral = 1e7;
  apply_learned(channel, learned);
  const auto problem = drop_unusable_tuning(channel, 1e-3);
  CHECK(problem.has_value());
  STRCMP_CONTAINS("unstable", problem->message.c_str());
  DOUBLES_EQUAL(1100.0, channel.controllers[0].pi.integral_W_per_m_s, 0.0);
}

TEST(BoardSettingsCheck, StoredTuningOfAnEstimatorThatCannotRunIsDroppedAndNamed) {
  ChannelSettings channel;
  channel.estimators[0].arithmetic = control::Arithmetic::q8_24;
  channel.estimators[0].gradient.normalisation = 0.5;
  board::Learned learned;
  learned.has_muscle = false;
  auto& values = learned.tuning.estimators[0].values;
  values[control::tunable_named("normalisation")] = 0.75;
  apply_learned(channel, learned);
  CHECK_FALSE(drop_unusable_tuning(channel, 1e-3).has_value());
  DOUBLES_EQUAL(0.75, channel.estimators[0].gradient.normalisation, 0.0);
  channel.estimators = channel.configured_estimators;
  values[control::tunable_named("normalisation")] = 1e6;
  apply_learned(channel, learned);
  const auto problem = drop_unusable_tuning(channel, 1e-3);
  CHECK(problem.has_value());
  STRCMP_EQUAL("normalisation", problem->key.c_str());
  STRCMP_CONTAINS("does not fit", problem->message.c_str());
  DOUBLES_EQUAL(0.5, channel.estimators[0].gradient.normalisation, 0.0);
}

TEST(BoardSettingsCheck, LoopDelayIsATickPlusTheHeatersDelay) {
  ChannelSettings channel;
  channel.heater.delay_s = 0.004;
  DOUBLES_EQUAL(0.005, loop_delay_s(channel, 0.001), 1e-15);
}

TEST_GROUP(AppliedSettings) {
  BoardSettings board;
  ChannelSettings& channel = board.channels[0];
  board::Learned learned;

  void setup() override {
    learned.muscle.stiffness_N_per_m = 14.0;
    learned.calibration = {0.001, 1.25, 9.5};
    learned.senses = {1.02, 0.98, 0.03, 1.7e9};
    learned.heat.time_constant_s = 1.75;
    learned.response_ratio = 0.5;
    learned.unexplained_ratio = 0.25;
    learned.identification = {{0.0, 0.2, 0.1, 0.05}, 1795219200.0};
    learned.tuning.estimator = 1.0;
  }
};

TEST(AppliedSettings, LearnedValuesReplaceConfiguredOnes) {
  const control::PhysicalParameters configured = channel.muscle;
  apply_learned(channel, learned);
  CHECK(channel.configured_muscle == configured);
  CHECK(channel.has_muscle && channel.muscle_identified);
  CHECK(channel.muscle == learned.muscle);
  CHECK(channel.calibration == learned.calibration);
  CHECK(channel.senses == learned.senses);
  CHECK(channel.heat == learned.heat);
  CHECK(channel.tuning == learned.tuning);
  DOUBLES_EQUAL(0.5, channel.response_ratio, 0.0);
  DOUBLES_EQUAL(0.25, channel.unexplained_ratio, 0.0);
  CHECK(channel.identification == learned.identification);
}

TEST(AppliedSettings, ASetWithoutAMuscleKeepsTheConfiguredMuscle) {
  learned.has_muscle = false;
  const ChannelSettings before = channel;
  apply_learned(channel, learned);
  CHECK_FALSE(channel.has_muscle || channel.muscle_identified);
  CHECK(channel.muscle == before.muscle && !channel.configured_muscle.has_value());
  CHECK(channel.calibration == before.calibration);
  DOUBLES_EQUAL(0.0, channel.response_ratio, 0.0);
  DOUBLES_EQUAL(0.0, channel.unexplained_ratio, 0.0);
  CHECK(channel.identification == board::Identification{});
  CHECK(channel.senses == learned.senses);
  CHECK(channel.heat == learned.heat);
  CHECK(channel.tuning == learned.tuning);
}

TEST(AppliedSettings, OnlyTheFirstFourControllersAreTuned) {
  const std::size_t integral = control::tunable_named("integral_W_per_m_s");
  channel.controllers.resize(5);
  for (control::ControllerSettings& controller : channel.controllers)
    controller.kind = control::ControllerKind::pi;
  learned.tuning.controllers[3].values[integral] = 800.0;
  learned.tuning.estimators[0].values[integral] = 700.0;  // a controller's value, so nobody uses it
  apply_learned(channel, learned);
  DOUBLES_EQUAL(800.0, channel.controllers[3].pi.integral_W_per_m_s, 0.0);
  DOUBLES_EQUAL(1100.0, channel.controllers[4].pi.integral_W_per_m_s, 0.0);
}

TEST(AppliedSettings, AStoredMuscleEqualToTheConfiguredOneIsNotIdentified) {
  learned.muscle = channel.muscle;
  apply_learned(channel, learned);
  CHECK_TRUE(channel.has_muscle);
  CHECK_FALSE(channel.muscle_identified);
}

TEST(AppliedSettings, PowerBoundsUseTheSenseComparison) {
  CHECK_FALSE(power_bounds(channel, board).compared());
  channel.senses.error_ratio = 0.02;
  CHECK_TRUE(power_bounds(channel, board).compared());
  DOUBLES_EQUAL(1.02 * 1.02, power_bounds(channel, board).true_over_measured().max, 1e-12);
  channel.thermal.min_power_ratio = 0.9;
  channel.thermal.max_power_ratio = 1.1;
  DOUBLES_EQUAL(1.02 * 1.02 * 1.1, power_bounds(channel, board).true_over_measured().max, 1e-12);
  DOUBLES_EQUAL(0.98 * 0.98 * 0.9, power_bounds(channel, board).true_over_measured().min, 1e-12);
}

TEST(AppliedSettings, TheProofUsesTheChannelsConfiguration) {
  channel.supervision.proof_of_response = false;
  channel.limiter.max_W = 3.5;
  channel.limiter.derate_from_C = 110.0;
  channel.supervision.trip_C = 150.0;
  channel.supervision.position_noise_rms_m = 7e-6;
  channel.supervision.responding_min_m = 0.004;
  channel.position.scaling.per_count = -2e-6;
  channel.thermal.boot_rise_K = 99.0;
  channel.senses.error_ratio = 0.02;
  ProofSettings s = proof_settings(channel, board);
  CHECK_FALSE(s.enabled);
  DOUBLES_EQUAL(3.5, s.max_W, 0.0);
  DOUBLES_EQUAL(110.0, s.derate_from_C, 0.0);
  DOUBLES_EQUAL(150.0, s.trip_C, 0.0);
  DOUBLES_EQUAL(7e-6, s.position_noise_rms_m, 0.0);
  DOUBLES_EQUAL(0.004, s.obvious_m, 0.0);
  DOUBLES_EQUAL(2e-6, s.count_m, 0.0);
  DOUBLES_EQUAL(99.0, s.thermal.boot_rise_K, 0.0);
  DOUBLES_EQUAL(1.02 * 1.02, s.max_power_ratio, 1e-12);
  DOUBLES_EQUAL(1.0, s.response_ratio, 0.0);
  channel.response_ratio = 0.5;
  DOUBLES_EQUAL(0.5, proof_settings(channel, board).response_ratio, 0.0);
}
