// Which controller is recommended for a muscle.
#include "config/recommended_controller.hpp"

#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/tracking/loop_margin.hpp"

#include "loop/promise.hpp"

using namespace supercoil;
using config::recommended_controller;
using config::RecommendedController;

TEST_GROUP(RecommendedController){};

TEST(RecommendedController, ASlowMuscleGetsALowerBandwidth) {
  control::PhysicalParameters muscle;
  const std::string usual = recommended_controller(muscle).literal();
  STRCMP_EQUAL("{ kind = \"learned_ff\", shape_reference = true, bandwidth_rad_per_s = 8 }",
               usual.c_str());
  muscle.thermal_mass_J_per_K *= 4.0;
  const RecommendedController slow = recommended_controller(muscle);
  DOUBLES_EQUAL(4.0, slow.bandwidth_rad_per_s, 2e-3);
  STRCMP_CONTAINS("8 rad/s over the square root of its time constant, 7.28 s, in units of",
                  slow.reason.c_str());
  muscle.thermal_mass_J_per_K /= 100.0;
  DOUBLES_EQUAL(8.0, recommended_controller(muscle).bandwidth_rad_per_s, 0.0);
}

TEST(RecommendedController, ADelayLowersTheBandwidthToKeepAMargin) {
  const control::PhysicalParameters muscle;
  const auto margin_at = [&](const RecommendedController& recommended, double delay_s) {
    const auto law = control::fixed_law(recommended.applied_to({}), muscle);
    return control::loop_margin(*law, muscle, 1e-3, delay_s);
  };
  const double at_once_s = 1e-3;
  DOUBLES_EQUAL(8.0, recommended_controller(muscle, {1e-3, at_once_s}).bandwidth_rad_per_s, 1e-3);
  double before = 8.0;
  for (const double delay_s : {0.05, 0.1, 0.5, 2.5}) {
    const RecommendedController recommended = recommended_controller(muscle, {1e-3, delay_s});
    CHECK(recommended.bandwidth_rad_per_s < before);
    before = recommended.bandwidth_rad_per_s;
    CHECK(recommended.pole_rad_per_s <= before);
    const auto margin = margin_at(recommended, delay_s);
    CHECK(margin.stable());
    CHECK(margin.modulus >= 0.4);
    CHECK(margin.modulus < 0.41);
  }
  STRCMP_CONTAINS("with 100 ms of delay, more bandwidth would leave a margin below 0.4",
                  recommended_controller(muscle, {1e-3, 0.1}).reason.c_str());
}

TEST(RecommendedController, AccountsForAChannelsDelayAndObstacles) {
  const BoardSettings board;
  ChannelSettings channel;
  channel.heater.delay_s = 0.1;
  const RecommendedController recommended = recommended_controller(channel, board);
  CHECK(recommended.bandwidth_rad_per_s < 5.0);
  STRCMP_EQUAL("", config::problem_of(recommended, channel, 1e-3).c_str());
  channel.controllers.front().arithmetic = control::Arithmetic::q8_24;
  STRCMP_CONTAINS("controller.arithmetic must be double or float",
                  config::problem_of(recommended, channel, 1e-3).c_str());
}

/// On a linear muscle feedback improves nothing and only adds noise.
TEST(RecommendedController, IsNotCalledCloserThanAControllerThatPromisesLess) {
  const BoardSettings board;
  ChannelSettings channel;
  channel.muscle_identified = true;
  channel.supervision.proof_of_response = false;
  channel.supervision.position_noise_rms_m = 10e-6;
  channel.position.scaling.per_count = 1e-6;
  control::ControllerSettings& in_use = channel.controllers.front();
  in_use.kind = control::ControllerKind::learned_ff;
  const auto promised_m = [&](const control::ControllerSettings& controller) {
    const FirstMotion motion =
        plan_first_motion(feasibility(channel, board), channel.unexplained_ratio);
    return promise_error(controller.learned_ff, channel, board, motion).error_m();
  };
  const auto suits_beside = [&](double bandwidth_rad_per_s, double unexplained_ratio) {
    in_use.learned_ff.bandwidth_rad_per_s = bandwidth_rad_per_s;
    channel.unexplained_ratio = unexplained_ratio;
    return recommended_controller(channel, board);
  };
  const RecommendedController kept = suits_beside(5.0, 1e-9);
  DOUBLES_EQUAL(5.0, kept.bandwidth_rad_per_s, 0.0);
  CHECK(promised_m(in_use) < promised_m(recommended_controller({}).applied_to(in_use)));
  STRCMP_CONTAINS("promises as small an error with 5 rad/s as with 8, and asks for no motion",
                  kept.reason.c_str());
  CHECK(kept.pole_rad_per_s <= 5.0);
  // It is recommended when it promises clearly less, and also when there is little to correct.
  const RecommendedController closer = suits_beside(5.0, 0.03);
  DOUBLES_EQUAL(8.0, closer.bandwidth_rad_per_s, 0.01);
  CHECK(promised_m(closer.applied_to(in_use)) < 0.95 * promised_m(in_use));
  STRCMP_CONTAINS("follows closest", closer.reason.c_str());
  const RecommendedController sooner = suits_beside(2.0, 1e-9);
  DOUBLES_EQUAL(8.0, sooner.bandwidth_rad_per_s, 0.01);
  STRCMP_CONTAINS("corrects what disturbs it sooner than 2 rad/s, which promises a smaller error",
                  sooner.reason.c_str());
  // The same but for rounding.
  for (const double in_use_rad_per_s : {7.9999, 8.0001}) {
    STRCMP_CONTAINS("follows closest, and asks for no motion",
                    suits_beside(in_use_rad_per_s, 1e-9).reason.c_str());
  }
}

TEST(RecommendedController, AStepOfAQuarterOfTheTravelIsJustFeasibleByTheReferenceModel) {
  control::PhysicalParameters muscle;
  const auto asks = [&](const RecommendedController& recommended) {
    return peak_W_per_m(recommended.applied_to({}).model, muscle) * muscle.dc_gain_m_per_W();
  };
  const RecommendedController usual = recommended_controller(muscle);
  DOUBLES_EQUAL(2.0, asks(usual), 5e-3);
  STRCMP_CONTAINS("falls from 90 to 10 % in 4 s by itself", usual.model_reason.c_str());
  STRCMP_EQUAL("{ kind = \"poles\", poles_rad_per_s = [3.276, 3.276, 3.276] }",
               usual.model_literal().c_str());
  muscle.thermal_mass_J_per_K *= 4.0;
  const RecommendedController slow = recommended_controller(muscle);
  DOUBLES_EQUAL(2.0, asks(slow), 5e-3);
  CHECK(slow.pole_rad_per_s < 0.3 * usual.pole_rad_per_s);
  // Not faster than the feedback, however fast the muscle.
  muscle.thermal_mass_J_per_K /= 100.0;
  DOUBLES_EQUAL(8.0, recommended_controller(muscle).pole_rad_per_s, 0.0);
  STRCMP_CONTAINS("no faster than the feedback",
                  recommended_controller(muscle).model_reason.c_str());
}

TEST(RecommendedController, DiffersByLawShapingOrATenthOfTheBandwidth) {
  const RecommendedController recommended = recommended_controller({});
  control::ControllerSettings controller = recommended.applied_to({});
  CHECK_FALSE(recommended.differs_from(controller));
  controller.learned_ff.bandwidth_rad_per_s *= 1.09;
  CHECK_FALSE(recommended.differs_from(controller));
  controller.learned_ff.bandwidth_rad_per_s *= 1.02;
  CHECK_TRUE(recommended.differs_from(controller));
  controller = recommended.applied_to({});
  controller.model = control::poles_model({1.0, 1.0, 1.0});
  CHECK_TRUE(recommended.differs_from(controller));
  controller.model = control::design_model();
  CHECK_TRUE(recommended.differs_from(controller));
  controller = recommended.applied_to({});
  controller.shape_reference = false;
  CHECK_TRUE(recommended.differs_from(controller));
  controller = recommended.applied_to({});
  controller.kind = control::ControllerKind::adaptive_ff;
  CHECK_TRUE(recommended.differs_from(controller));
}
