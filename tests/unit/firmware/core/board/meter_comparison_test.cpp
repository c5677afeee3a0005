#include "board/meter_comparison.hpp"

#include <array>
#include <cmath>
#include <optional>

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using board::MeterComparison;

/// A board whose senses read a given fraction of the truth, and a person with a good meter.
TEST_GROUP(MeterComparison) {
  static constexpr double step_s = 1e-3;
  static constexpr double supply_V = 12.0;
  static constexpr double heater_Ohm = 10.0;
  static constexpr board::PowerBounds::Interval resistance_Ohm{10.0, 10.5};
  static constexpr MeterComparison::Settings settings{9.0, 15.0, 0.3, 0.002, 0.0005};
  MeterComparison comparison{settings, step_s};
  board::SenseComparison present;
  double supply_reading_ratio = 0.9;
  double current_reading_ratio = 0.8;
  double duty = 0.0;

  double line_A() const {
    return duty * supply_V / heater_Ohm;
  }
  void hold(double new_duty, double time_s = 1.2) {
    duty = new_duty;
    comparison.restart();
    for (int i = 0; i < std::lround(time_s / step_s); ++i)
      comparison.step(duty, supply_reading_ratio * supply_V, current_reading_ratio * line_A());
  }
  Refusal volts(double meter_V) {
    return comparison.read(MeterComparison::supply, meter_V, present, resistance_Ohm);
  }
  Refusal amperes(double meter_A) {
    return comparison.read(MeterComparison::current, meter_A, present, resistance_Ohm);
  }
  void check(Refusal expected, Refusal refusal) {
    STRCMP_EQUAL(std::string(name(expected)).c_str(), std::string(name(refusal)).c_str());
  }
  void read_both() {
    check(Refusal::none, volts(supply_V));
    check(Refusal::none, amperes(line_A()));
  }
  /// A current sense that gives whole counts; `counts` is the unrounded number at the first power.
  /// typed: the meter's reading as the person types it, over the truth, at each power.
  std::optional<board::SenseComparison> compare_in_counts(double counts, double ratio,
                                                          const std::array<double, 2>& typed) {
    MeterComparison::Settings coarse = settings;
    coarse.current_step_A = 0.1 * supply_V / heater_Ohm / counts;
    comparison = MeterComparison(coarse, step_s);
    for (std::size_t i = 0; i < typed.size(); ++i) {
      duty = i == 0 ? 0.1 : 0.1 * ratio;
      const double reading_A = coarse.current_step_A * std::round(line_A() / coarse.current_step_A);
      comparison.restart();
      for (int k = 0; k < 1000; ++k)
        comparison.step(duty, supply_V, reading_A);
      if (volts(supply_V) != Refusal::none || amperes(typed[i] * line_A()) != Refusal::none)
        return {};
    }
    return comparison.found();
  }
  /// After a refusal, the readings before it are discarded.
  void check_forgotten() {
    hold(0.2);
    read_both();
    CHECK_FALSE(comparison.found().has_value());
  }
};

TEST(MeterComparison, FindsTheGainsFromTwoPowers) {
  hold(0.1);
  read_both();
  CHECK_FALSE(comparison.found().has_value());
  hold(0.2);
  check(Refusal::none, volts(supply_V));
  CHECK_FALSE(comparison.found().has_value());
  check(Refusal::none, amperes(line_A()));
  const auto found = comparison.found();
  CHECK(found.has_value());
  DOUBLES_EQUAL(1.0 / supply_reading_ratio, found->supply_gain, 1e-9);
  DOUBLES_EQUAL(1.0 / current_reading_ratio, found->current_gain, 1e-9);
  DOUBLES_EQUAL(0.02, found->error_ratio, 1e-9);
  DOUBLES_EQUAL(0.0, found->compared_s, 0.0);
}

TEST(MeterComparison, WaitsForVoltsWhenAmperesAreReadFirst) {
  hold(0.1);
  read_both();
  hold(0.2);
  check(Refusal::none, amperes(line_A()));
  CHECK_FALSE(comparison.found().has_value());
  check(Refusal::none, volts(supply_V));
  CHECK_TRUE(comparison.found().has_value());
}

TEST(MeterComparison, FindsGainsOverTheUncorrectedReadings) {
  present = {1.25, 0.8, 0.05, 1.0};
  supply_reading_ratio = 1.25 * 0.9;
  current_reading_ratio = 0.8 * 0.9;
  for (const double d : {0.1, 0.2}) {
    hold(d);
    read_both();
  }
  DOUBLES_EQUAL(1.0 / 0.9, comparison.found()->supply_gain, 1e-9);
  DOUBLES_EQUAL(1.0 / 0.9, comparison.found()->current_gain, 1e-9);
}

TEST(MeterComparison, WaitsUntilThePowerIsSteady) {
  hold(0.1, 0.99);
  check(Refusal::not_ready, volts(supply_V));
  hold(0.1, 1.0);
  check(Refusal::none, volts(supply_V));
  comparison.restart();
  check(Refusal::not_ready, amperes(line_A()));
}

TEST(MeterComparison, OnePowerIsNotEnough) {
  hold(0.1);
  read_both();
  read_both();
  for (const double d : {0.1 * 1.04, 0.1 * 1.39, 0.1 * 0.5}) {
    hold(d);
    check(d < 0.105 && d > 0.1 ? Refusal::none : Refusal::not_ready, volts(supply_V));
    CHECK_FALSE(comparison.found().has_value());
  }
  hold(0.1 * 1.5);
  read_both();
  CHECK(comparison.found().has_value());
}

TEST(MeterComparison, OneSenseAloneIsNotCompared) {
  for (const double d : {0.1, 0.2}) {
    hold(d);
    check(Refusal::none, volts(supply_V));
  }
  CHECK_FALSE(comparison.found().has_value());
}

TEST(MeterComparison, AnySingleMistypedReadingIsRefused) {
  for (int wrong = 0; wrong < 4; ++wrong) {
    for (const double by : {0.9, 0.97, 1.03, 1.1}) {
      comparison.forget();
      bool refused = false;
      for (int i = 0; i < 4; ++i) {
        if (i % 2 == 0) hold(i == 0 ? 0.1 : 0.2);
        const double typed = i == wrong ? by : 1.0;
        const Refusal refusal = i % 2 == 0 ? volts(typed * supply_V) : amperes(typed * line_A());
        refused = refused || refusal == Refusal::out_of_range;
      }
      CHECK(refused);
      CHECK_FALSE(comparison.found().has_value());
    }
  }
}

TEST(MeterComparison, SwappedReadingsAreRefusedAndDiscardEarlierOnes) {
  hold(0.1);
  check(Refusal::none, volts(supply_V));
  check(Refusal::out_of_range, amperes(supply_V));
  check_forgotten();
  check(Refusal::out_of_range, volts(line_A()));
  hold(0.3);
  read_both();
  CHECK_FALSE(comparison.found().has_value());
}

TEST(MeterComparison, ASupplyThatTheConfigurationDoesNotAllowIsRefused) {
  supply_reading_ratio = 1.0;
  hold(0.1);
  for (const double meter_V : {8.99, 15.01}) {
    check(Refusal::out_of_range, volts(meter_V));
    check(Refusal::out_of_range, volts(meter_V));
  }
  check(Refusal::none, volts(9.0));
  check(Refusal::none, volts(15.0));
}

TEST(MeterComparison, AGainBeyondItsRangeIsRefused) {
  for (const double gain : {1.0 / 0.69, 1.0 / 1.41}) {
    current_reading_ratio = gain;
    hold(0.1);
    check(Refusal::out_of_range, amperes(line_A()));
  }
  for (const double gain : {1.0 / 0.71, 1.0 / 1.39}) {
    current_reading_ratio = gain;
    hold(0.1);
    check(Refusal::none, amperes(line_A()));
  }
}

TEST(MeterComparison, AResistanceThatIsNotTheConfiguredOneIsRefused) {
  const double min_A = 0.1 * supply_V / (10.5 * 1.3);
  const double max_A = 0.1 * supply_V / (10.0 * 0.7);
  for (const double meter_A : {0.99 * min_A, 1.01 * max_A, 1.01 * min_A, 0.99 * max_A}) {
    const bool fits = meter_A > min_A && meter_A < max_A;
    hold(0.1);
    current_reading_ratio = meter_A / line_A();  // so that the gain is not the reason
    hold(0.1);
    check(Refusal::none, volts(supply_V));
    check(fits ? Refusal::none : Refusal::out_of_range, amperes(meter_A));
    comparison.forget();
  }
}

TEST(MeterComparison, NonsenseIsRefused) {
  hold(0.1);
  for (const double nonsense : {std::nan(""), -12.0, 0.0, HUGE_VAL, 1e30}) {
    check(Refusal::out_of_range, volts(nonsense));
    check(Refusal::out_of_range, amperes(nonsense));
  }
}

TEST(MeterComparison, SenseResolutionRemainsAsError) {
  // A count of 1.5 mA is a hundredth of 0.15 A, and a hundredth a meter's error: it grows from
  // there.
  MeterComparison::Settings coarse = settings;
  coarse.current_step_A = 0.05 * 0.8 * 0.12;
  comparison = MeterComparison(coarse, step_s);
  for (const double d : {0.1, 0.2}) {
    hold(d);
    read_both();
  }
  DOUBLES_EQUAL(0.06, comparison.found()->error_ratio, 1e-9);
}

/// A converter without noise gives whole counts, and each power lies between two of them.
TEST(MeterComparison, QuantisedReadingsAreNotRefused) {
  supply_reading_ratio = 1.0;
  for (int i = 0; i < 400; ++i) {
    const double counts = 8.0 + 0.13 * i;
    for (const double ratio : {1.5, 2.0, 2.1}) {
      const auto found = compare_in_counts(counts, ratio, {1.0, 1.0});
      CHECK(found.has_value());
      CHECK_COMPARE(std::abs(found->current_gain - 1.0), <=, found->error_ratio);
      // Not more than a count, a meter and two powers account for.
      CHECK_COMPARE(found->error_ratio, <=, 0.02 + 1.0 / (counts - 0.5));
    }
  }
}

TEST(MeterComparison, AMistypedReadingAtFewCountsIsRefusedOrWithinTheError) {
  supply_reading_ratio = 1.0;
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    const double counts = 8.0 + 0.13 * i;
    for (const double by : {0.8, 0.9, 0.95, 0.97, 1.03, 1.05, 1.1, 1.2}) {
      for (const std::array<double, 2>& typed : {std::array{by, 1.0}, std::array{1.0, by}}) {
        const auto found = compare_in_counts(counts, 2.0, typed);
        refused += found ? 0 : 1;
        if (!found) continue;
        CHECK_COMPARE(std::abs(found->current_gain - 1.0), <=, found->error_ratio);
      }
    }
  }
  CHECK_COMPARE(refused, >, 3000);
}

TEST(MeterComparison, TooCoarseASenseIsRefused) {
  MeterComparison::Settings coarse = settings;
  coarse.current_step_A = 0.2 * 0.8 * 0.12;
  comparison = MeterComparison(coarse, step_s);
  hold(0.1);
  read_both();
  hold(0.2);
  check(Refusal::none, volts(supply_V));
  check(Refusal::out_of_range, amperes(line_A()));
  CHECK_FALSE(comparison.found().has_value());
}

TEST(MeterComparison, WaitsForASteadySecondFromTheFirstTick) {
  duty = 0.1;
  for (int i = 0; i < 999; ++i)
    comparison.step(duty, supply_reading_ratio * supply_V, current_reading_ratio * line_A());
  check(Refusal::not_ready, volts(supply_V));
  comparison.step(duty, supply_reading_ratio * supply_V, current_reading_ratio * line_A());
  check(Refusal::none, volts(supply_V));
}

TEST(MeterComparison, FiltersTheSensesAsSlowlyAsAMetersDisplay) {
  supply_reading_ratio = current_reading_ratio = 1.0;
  for (const double d : {0.1, 0.2}) {
    hold(d, 3.0);
    // Half a second later, one time constant, 63 % of a change has arrived.
    for (int i = 0; i < 500; ++i)
      comparison.step(duty, 0.99 * supply_V, line_A());
    read_both();
  }
  DOUBLES_EQUAL(1.0 / (1.0 - 0.01 * (1.0 - std::exp(-1.0))), comparison.found()->supply_gain, 1e-5);
}
