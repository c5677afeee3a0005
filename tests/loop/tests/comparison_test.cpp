// Senses that lie, compared with a meter.
#include <cmath>
#include <utility>

#include <CppUTest/TestHarness.h>

#include "loop/support/can_rig.hpp"
#include "loop/support/rig.hpp"

using namespace supercoil;

/// A person with a meter, and a channel at a power.
TEST_GROUP(Comparison) {
  static constexpr double supply_gain = 0.9;  ///< measured over true
  static constexpr double current_gain = 0.8;
  static constexpr double supply_V = 12.0;

  /// Makes a converter read `gain` times the truth without the board knowing.
  static void set_gain_error(host_sim::ConverterSettings & converter, double gain) {
    converter.low /= gain;
    converter.high /= gain;
  }
  static test::RigSettings miscalibrated_board() {
    test::RigSettings wrong = test::rough_board();
    wrong.firmware.supervision.min_supply_V = 9.0;
    wrong.firmware.supervision.max_supply_V = 15.0;
    set_gain_error(wrong.board.supply, supply_gain);
    set_gain_error(wrong.board.channels[0].current, current_gain);
    // With a resistance that tells its temperature, sensors_disagree would notice such a lie.
    wrong.board.channels[0].temperature_coefficient_per_K = 0.0;
    wrong.firmware.channels[0].heater.temperature_coefficient_per_K = 0.0;
    return wrong;
  }

  test::RigSettings settings = miscalibrated_board();
  test::Rig rig{settings};

  Channel& channel() {
    return rig.loop.channel(test::Rig::tested);
  }
  void start() {
    rig.boot();
    rig.arm();
    rig.run(0.1);
  }
  void hold(double power_W, double time_s = 2.5) {
    rig.hold_power(power_W, time_s);
  }
  Refusal answer_to(Verb verb, double value) {
    return rig.answer_to(verb, value);
  }
  /// The mean current, as a meter in the line shows it.
  double line_A() {
    double sum_A = 0.0;
    for (int i = 0; i < 100; ++i) {
      if (i % 50 == 0) rig.send(Verb::renew);
      rig.run_ticks(1);
      sum_A += rig.muscle().true_power_W() / supply_V;
    }
    return sum_A / 100.0;
  }
  /// The power given when 4 W are demanded, and whether the proof of response limits it.
  std::pair<double, bool> given_of_4_W(test::Rig & tested) {
    for (int i = 0; i < 20; ++i) {
      tested.send(Verb::power, 4.0);
      tested.run(0.05);
    }
    const Snapshot& s = tested.snapshot();
    return {s.applied_W, s.limited_by == LimitedBy::unproven};
  }
  void check(Refusal expected, Refusal refusal) {
    STRCMP_EQUAL(std::string(name(expected)).c_str(), std::string(name(refusal)).c_str());
  }
  void read_both() {
    check(Refusal::none, answer_to(Verb::compare_supply, supply_V));
    check(Refusal::none, answer_to(Verb::compare_current, line_A()));
  }
  std::optional<board::Learned> update() {
    board::LearnedUpdate update;
    channel().take_learned_update(update);
    return update;
  }
  /// How many probes began while a power was held.
  int probes(double power_W, double time_s) {
    int begun = 0;
    bool probing = rig.snapshot().probing;
    for (int i = 0; i < std::lround(time_s / rig.period_s()); ++i) {
      if (i % 50 == 0) rig.send(Verb::power, power_W);
      rig.run_ticks(1);
      const bool probes_now = rig.snapshot().probing;
      begun += probes_now && !probing ? 1 : 0;
      probing = probes_now;
    }
    return begun;
  }
  /// As wide as before: nothing is stored, and the readings are those of lying senses.
  void check_nothing_changed() {
    CHECK_FALSE(update().has_value());
    DOUBLES_EQUAL(supply_gain * supply_V, rig.snapshot().supply_V, 0.02);
    CHECK(rig.fault() == Fault::none);
    CHECK_FALSE(rig.interval_missed);
  }
  /// The width of the temperature's interval at this power, once it has settled.
  double width_K(double power_W) {
    hold(power_W, 25.0);
    return rig.snapshot().hottest_C - rig.snapshot().coldest_C;
  }
};

TEST(Comparison, FindsTheGainsAndNarrowsTheBounds) {
  start();
  const double wide_K = width_K(0.5);
  read_both();
  check_nothing_changed();
  hold(1.0);
  read_both();
  const auto found = update();
  CHECK(found.has_value());
  DOUBLES_EQUAL(1.0 / supply_gain, found->senses.supply_gain, 0.005);
  DOUBLES_EQUAL(1.0 / current_gain, found->senses.current_gain, 0.01);
  CHECK(found->senses.error_ratio >= 0.02);
  CHECK(found->senses.error_ratio <= 0.05);
  CHECK_FALSE(found->has_muscle);  // it was never learned, and the configured one is not stored

  const double narrow_K = width_K(0.5);
  printf("%.1f K wide, compared %.1f K\n", wide_K, narrow_K);
  CHECK_COMPARE(narrow_K, <, 0.6 * wide_K);
  DOUBLES_EQUAL(supply_V, rig.snapshot().supply_V, 0.05);
  DOUBLES_EQUAL(line_A(), rig.snapshot().current_A, 0.005);
  hold(4.0, 30.0);
  hold(0.0, 30.0);
  hold(2.0, 30.0);
  CHECK_FALSE(rig.interval_missed);
  CHECK(rig.fault() == Fault::none);
}

TEST(Comparison, OneMistypedReadingChangesNothing) {
  start();
  hold(0.5);
  read_both();
  hold(1.0);
  check(Refusal::none, answer_to(Verb::compare_supply, supply_V));
  check(Refusal::out_of_range, answer_to(Verb::compare_current, 1.1 * line_A()));
  check_nothing_changed();
  // Which reading was wrong is not known, so a right one alone does not help either.
  read_both();
  check_nothing_changed();
}

TEST(Comparison, SwappedReadingsChangeNothing) {
  start();
  for (const double power_W : {0.5, 1.0}) {
    hold(power_W);
    check(Refusal::out_of_range, answer_to(Verb::compare_supply, line_A()));
    check(Refusal::out_of_range, answer_to(Verb::compare_current, supply_V));
  }
  check_nothing_changed();
}

TEST(Comparison, ReadingsOfOnePowerChangeNothing) {
  start();
  hold(0.5);
  read_both();
  read_both();
  hold(0.6);
  check(Refusal::not_ready, answer_to(Verb::compare_supply, supply_V));
  check_nothing_changed();
}

TEST(Comparison, ReadingsFromBeforeADisarmAreForgotten) {
  start();
  hold(0.5);
  read_both();
  rig.send(Verb::disarm);
  rig.run(0.1);
  rig.arm();
  rig.run(0.1);
  hold(1.0);
  read_both();
  check_nothing_changed();
}

TEST(Comparison, RequiresASteadyPower) {
  start();
  check(Refusal::wrong_state, answer_to(Verb::compare_supply, supply_V));
  hold(0.5, 0.6);
  check(Refusal::not_ready, answer_to(Verb::compare_supply, supply_V));
  rig.send(Verb::position, 0.002);
  rig.run(0.1);
  check(Refusal::wrong_state, answer_to(Verb::compare_supply, supply_V));
  check(Refusal::wrong_state, answer_to(Verb::compare_current, 0.05));
  check_nothing_changed();
}

TEST(Comparison, IsForgottenOnRequest) {
  start();
  for (const double power_W : {0.5, 1.0}) {
    hold(power_W);
    read_both();
  }
  CHECK(update()->senses.compared());
  check(Refusal::wrong_state, answer_to(Verb::compare_supply, 0.0));
  rig.send(Verb::rest);
  check(Refusal::none, answer_to(Verb::compare_supply, 0.0));
  const auto forgotten = update();
  CHECK(forgotten.has_value());
  CHECK(forgotten->senses == board::SenseComparison{});
  rig.run(0.1);
  DOUBLES_EQUAL(supply_gain * supply_V, rig.snapshot().supply_V, 0.02);
}

TEST(Comparison, UpdatesThePowerBoundsOfTheProofImmediately) {
  settings.firmware.channels[0].muscle_identified = true;
  test::Rig known(settings);
  known.boot();
  known.arm();
  known.run(0.1);
  const auto [wide_W, wide_limited] = given_of_4_W(known);
  // At 9 V, the supply's lowest, the truth may be 15 V, and the resistance 30 % off.
  const ProofSettings worst = proof_settings(settings.firmware.channels[0], settings.firmware);
  DOUBLES_EQUAL(1.3 * std::pow(15.0 / 9.0, 2), worst.max_power_ratio, 1e-9);
  CHECK(wide_limited);
  CHECK_COMPARE(wide_W, <, 1.6);
  for (const double power_W : {0.5, 1.0}) {
    for (int i = 0; i < 50; ++i) {
      known.send(Verb::power, power_W);
      known.run(0.05);
    }
    known.send(Verb::compare_supply, supply_V);
    known.send(Verb::compare_current, known.muscle().true_power_W() / supply_V);
    known.run_ticks(1);
  }
  CHECK(known.loop.channel(0).senses().compared());
  const auto [narrow_W, narrow_limited] = given_of_4_W(known);
  CHECK_FALSE(narrow_limited);
  CHECK_COMPARE(narrow_W, >, 3.7);
  known.send(Verb::rest);
  known.run_ticks(1);
  known.send(Verb::compare_supply, 0.0);
  known.run_ticks(1);
  const auto [forgotten_W, forgotten_limited] = given_of_4_W(known);
  CHECK(forgotten_limited);
  CHECK_COMPARE(forgotten_W, <, 1.6);
}

TEST(Comparison, CorrectsTheCalibratedResistance) {
  // As calibrate found it through senses that read 0.9 and 0.8 of the truth.
  const double reported_Ohm = 10.0 * supply_gain / current_gain;
  settings.firmware.channels[0].calibration.cold_resistance_Ohm = reported_Ohm;
  settings.firmware.channels[0].has_muscle = true;
  test::Rig calibrated(settings);
  calibrated.boot();
  calibrated.arm();
  calibrated.run(0.1);
  board::LearnedUpdate found;
  for (const double power_W : {0.5, 1.0}) {
    for (int i = 0; i < 50; ++i) {
      calibrated.send(Verb::power, power_W);
      calibrated.run(0.05);
    }
    calibrated.send(Verb::compare_supply, supply_V);
    calibrated.send(Verb::compare_current, calibrated.muscle().true_power_W() / supply_V);
    calibrated.run_ticks(1);
  }
  CHECK(calibrated.loop.channel(0).take_learned_update(found));
  CHECK(found->has_muscle);
  DOUBLES_EQUAL(10.0, found->calibration.cold_resistance_Ohm, 0.2);
  for (int i = 0; i < 100; ++i) {
    calibrated.send(Verb::power, 1.0);
    calibrated.run(0.05);
  }
  CHECK(calibrated.fault() == Fault::none);
  CHECK_FALSE(calibrated.interval_missed);
}

TEST(Comparison, WorksOverCan) {
  test::CanRig can(miscalibrated_board());
  test::Master master;
  can.run(16.0);
  can.claim(master);
  can.command(master, Verb::arm);
  can.run(0.2);
  for (const float power_W : {0.5F, 1.0F}) {
    for (int i = 0; i < 20; ++i) {
      can.command(master, Verb::power, power_W);
      can.run(0.1);
    }
    const auto line_A = static_cast<float>(can.true_power_W() / supply_V);
    CHECK(can.command(master, telemetry::compare, 12.0F) == Refusal::none);
    CHECK(can.command(master, telemetry::compare, -line_A) == Refusal::none);
  }
  board::LearnedUpdate found;
  CHECK(can.loop.channel(0).take_learned_update(found));
  DOUBLES_EQUAL(1.0 / supply_gain, found->senses.supply_gain, 0.005);
  DOUBLES_EQUAL(1.0 / current_gain, found->senses.current_gain, 0.02);
}

/// A resistance that compared senses calibrated becomes what they would report uncompared.
TEST(Comparison, ForgettingRestoresTheUncorrectedResistance) {
  settings.firmware.channels[0].senses = {1.0 / supply_gain, 1.0 / current_gain, 0.03, 0.0};
  settings.firmware.channels[0].calibration.cold_resistance_Ohm = 10.4;
  settings.firmware.channels[0].has_muscle = true;
  test::Rig compared(settings);
  compared.boot();
  check(Refusal::none, compared.answer_to(Verb::compare_supply, 0.0));
  board::LearnedUpdate found;
  CHECK(compared.loop.channel(0).take_learned_update(found));
  DOUBLES_EQUAL(10.4 * supply_gain / current_gain, found->calibration.cold_resistance_Ohm, 1e-9);
}

/// At low power, pulses measure the heater's resistance, and the meter may be read at any moment
/// between two of them.
TEST(Comparison, AtLowPowerIsNotDisturbedByProbes) {
  start();
  for (int i = 0; i < 12; ++i) {
    hold(0.1, 3.0 + 0.45 * i);
    read_both();
    hold(0.2, 5.5);
    read_both();
    const auto found = update();
    CHECK(found.has_value());
    const board::SenseComparison& senses = found->senses;
    DOUBLES_EQUAL(1.0 / supply_gain, senses.supply_gain, senses.error_ratio / supply_gain);
    DOUBLES_EQUAL(1.0 / current_gain, senses.current_gain, senses.error_ratio / current_gain);
    CHECK_COMPARE(senses.error_ratio, <, 0.1);
    rig.send(Verb::rest);
    check(Refusal::none, answer_to(Verb::compare_supply, 0.0));
    update();
  }
}

TEST(Comparison, SuspendsProbesUntilBothMetersAreRead) {
  start();
  hold(0.1, 6.0);
  check(Refusal::none, answer_to(Verb::compare_supply, supply_V));
  const int before = probes(0.1, 30.0);
  CHECK_EQUAL(0, before);
  check(Refusal::none, answer_to(Verb::compare_current, line_A()));
  const int between = probes(0.2, 30.0);
  CHECK_EQUAL(0, between);
  read_both();
  CHECK(update().has_value());
  const int after = probes(0.2, 30.0);
  CHECK_COMPARE(after, >, 3);
}

/// The heater of a comparison that was abandoned is probed again.
TEST(Comparison, AbandonedComparisonLetsProbesResume) {
  start();
  hold(0.1, 6.0);
  check(Refusal::none, answer_to(Verb::compare_supply, supply_V));
  const int meanwhile = probes(0.1, 590.0);
  CHECK_EQUAL(0, meanwhile);
  const int at_last = probes(0.1, 20.0);
  CHECK_EQUAL(1, at_last);
}
