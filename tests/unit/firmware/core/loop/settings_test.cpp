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

/// Of whatever law and model it was made, and whatever was changed underway.
TEST(BoardSettingsCheck, WhatWasStoredMakesTheSameControllerAgain) {
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
        board::TunedController::difference(now, configured).apply_to(again);
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

TEST(BoardSettingsCheck, TheLoopsDelayIsATickAndTheHeaters) {
  ChannelSettings channel;
  channel.heater.delay_s = 0.004;
  DOUBLES_EQUAL(0.005, loop_delay_s(channel, 0.001), 1e-15);
}
