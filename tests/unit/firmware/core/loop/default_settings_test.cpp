// The defaults that apply where a board's file says nothing.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "board/air.hpp"
#include "board/known_heat.hpp"
#include "board/learned.hpp"
#include "board/measurement.hpp"
#include "board/resistance.hpp"
#include "loop/settings.hpp"
#include "supervisor/limiter.hpp"
#include "supervisor/proof.hpp"
#include "supervisor/supervision.hpp"

using namespace supercoil;

TEST_GROUP(DefaultSettings){};

TEST(DefaultSettings, OfABoard) {
  const BoardSettings board;
  DOUBLES_EQUAL(1000.0, board.rate_Hz, 0.0);
  DOUBLES_EQUAL(1e-3, board.step_s(), 0.0);
  LONGS_EQUAL(1, board.channels.size());
  // A count is a unit, and a value may be ten periods old.
  for (const InputSettings& input :
       {board.supply, board.air, board.channels[0].position, board.channels[0].heater.current}) {
    DOUBLES_EQUAL(1.0, input.scaling.per_count, 0.0);
    DOUBLES_EQUAL(0.0, input.scaling.offset, 0.0);
    DOUBLES_EQUAL(0.01, input.max_age_s, 0.0);
  }
}

TEST(DefaultSettings, OfAChannelHaveNothingLearned) {
  const ChannelSettings channel;
  CHECK_FALSE(channel.has_muscle || channel.muscle_identified);
  DOUBLES_EQUAL(0.0, channel.response_ratio, 0.0);
  DOUBLES_EQUAL(0.0, channel.unexplained_ratio, 0.0);
  CHECK_FALSE(channel.senses.compared());
  CHECK_FALSE(channel.heat.has_time_constant() || channel.heat.has_reading());
  CHECK(channel.tuning == board::StoredTuning{});
  LONGS_EQUAL(1, channel.controllers.size());
  LONGS_EQUAL(1, channel.estimators.size());
  LONGS_EQUAL(0, channel.configured_controllers.size());
}

TEST(DefaultSettings, OfAJoint) {
  const JointSettings joint;
  LONGS_EQUAL(0, joint.agonist);
  LONGS_EQUAL(1, joint.antagonist);
  DOUBLES_EQUAL(1.0, joint.co_contraction_W, 0.0);
  CHECK(std::isinf(joint.max_co_contraction_W));
  DOUBLES_EQUAL(1.0, joint.antagonist_lever_ratio, 0.0);
  CHECK(std::isnan(joint.pretension_N));
  DOUBLES_EQUAL(0.5, joint.stiffness_ratios()[0], 0.0);
  DOUBLES_EQUAL(0.5, joint.stiffness_ratios()[1], 0.0);
}

TEST(DefaultSettings, OfAHeater) {
  const HeaterSettings heater;
  DOUBLES_EQUAL(0.0, heater.sense_filter_s, 0.0);
  DOUBLES_EQUAL(0.2, heater.resistance_filter_s, 0.0);
  DOUBLES_EQUAL(10.0, heater.cold_resistance_Ohm, 0.0);
  DOUBLES_EQUAL(0.0, heater.temperature_coefficient_per_K, 0.0);
  DOUBLES_EQUAL(0.02, heater.probe_duty, 0.0);
  DOUBLES_EQUAL(0.05, heater.probe_s, 0.0);
  DOUBLES_EQUAL(5.0, heater.probe_every_s, 0.0);
  CHECK_TRUE(heater.error_feedback);
  DOUBLES_EQUAL(0.0, heater.delay_s, 0.0);
  const board::Resistance::Settings resistance;
  DOUBLES_EQUAL(heater.sense_filter_s, resistance.sense_filter_s, 0.0);
  DOUBLES_EQUAL(heater.resistance_filter_s, resistance.smoothing_s, 0.0);
  DOUBLES_EQUAL(heater.probe_duty, resistance.probe_duty, 0.0);
  DOUBLES_EQUAL(heater.cold_resistance_Ohm, resistance.initial_Ohm, 0.0);
  DOUBLES_EQUAL(0.1, resistance.min_Ohm, 0.0);
  DOUBLES_EQUAL(1e5, resistance.max_Ohm, 0.0);
}

TEST(DefaultSettings, OfThermalBoundsAreTheWidest) {
  const board::ThermalSettings thermal;
  CHECK_FALSE(thermal.weighed());
  DOUBLES_EQUAL(0.13, thermal.bounds.min_mass_J_per_K, 0.0);
  DOUBLES_EQUAL(0.20, thermal.bounds.max_mass_J_per_K, 0.0);
  DOUBLES_EQUAL(0.045, thermal.bounds.min_transfer_W_per_K, 0.0);
  DOUBLES_EQUAL(0.18, thermal.bounds.max_transfer_W_per_K, 0.0);
  DOUBLES_EQUAL(1.0, thermal.min_power_ratio, 0.0);
  DOUBLES_EQUAL(1.0, thermal.max_power_ratio, 0.0);
  DOUBLES_EQUAL(0.162, thermal.thermal_mass_J_per_K, 0.0);
  DOUBLES_EQUAL(0.0, thermal.mass_error_ratio, 0.0);
  DOUBLES_EQUAL(0.25, thermal.time_constant_error_ratio, 0.0);
  DOUBLES_EQUAL(1.0, thermal.thermometer_error_K, 0.0);
  // In the warmest air this is 160 °C, where nothing heats.
  DOUBLES_EQUAL(135.0, thermal.boot_rise_K, 0.0);
  DOUBLES_EQUAL(25.0, thermal.air.warmest_C, 0.0);
  DOUBLES_EQUAL(15.0, thermal.air.coldest_C, 0.0);
  DOUBLES_EQUAL(0.0, thermal.air.error_K, 0.0);
}

TEST(DefaultSettings, OfALimiter) {
  const LimiterSettings limiter;
  DOUBLES_EQUAL(4.5, limiter.max_W, 0.0);
  DOUBLES_EQUAL(0.0, limiter.min_W, 0.0);
  DOUBLES_EQUAL(1e6, limiter.slew_W_per_s, 0.0);
  DOUBLES_EQUAL(130.0, limiter.derate_from_C, 0.0);
  DOUBLES_EQUAL(160.0, limiter.derate_to_C, 0.0);
}

/// docs/faults/ does not mention this value.
TEST(DefaultSettings, OfTheNoiseOfACurrentSense) {
  DOUBLES_EQUAL(0.01, ChannelSupervision{}.current_noise_A, 0.0);
}

TEST(DefaultSettings, OfAProof) {
  const ProofSettings proof;
  CHECK_TRUE(proof.enabled);
  DOUBLES_EQUAL(1.0, proof.max_power_ratio, 0.0);
  DOUBLES_EQUAL(1.0, proof.response_ratio, 0.0);
  DOUBLES_EQUAL(ChannelSupervision{}.responding_min_m, proof.obvious_m, 0.0);
  // These limits give a muscle no power: a caller that wants a proof must set them.
  for (const double limit :
       {proof.max_W, proof.derate_from_C, proof.trip_C, proof.position_noise_rms_m, proof.count_m})
    DOUBLES_EQUAL(0.0, limit, 0.0);
}

TEST(DefaultSettings, OfLearnedValuesChangeNothing) {
  const board::Calibration calibration;
  DOUBLES_EQUAL(0.0, calibration.position_offset_m, 0.0);
  DOUBLES_EQUAL(1.0, calibration.position_scale, 0.0);
  DOUBLES_EQUAL(10.0, calibration.cold_resistance_Ohm, 0.0);
  const board::SenseComparison senses;
  DOUBLES_EQUAL(1.0, senses.supply_gain, 0.0);
  DOUBLES_EQUAL(1.0, senses.current_gain, 0.0);
  DOUBLES_EQUAL(0.0, senses.error_ratio, 0.0);
  DOUBLES_EQUAL(0.0, senses.compared_s, 0.0);
  const board::ThermalFacts heat;
  for (const double value : {heat.time_constant_s, heat.time_constant_at_W, heat.steady_rise_K,
                             heat.steady_error_K, heat.steady_min_W, heat.steady_max_W})
    DOUBLES_EQUAL(0.0, value, 0.0);
  const board::Learned learned;
  CHECK_TRUE(learned.has_muscle);
  UNSIGNED_LONGS_EQUAL(0, learned.version);
  DOUBLES_EQUAL(0.0, learned.response_ratio, 0.0);
  DOUBLES_EQUAL(0.0, learned.unexplained_ratio, 0.0);
}
