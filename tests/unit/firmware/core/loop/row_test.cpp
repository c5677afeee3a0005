// A row has each quantity of its snapshot in its own place.
#include "loop/row.hpp"

#include <array>
#include <bit>
#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(RowOf){};

TEST(RowOf, FlagsAreDistinctBits) {
  constexpr std::array flags{row_probing,   row_trusted,    row_limited,
                             row_proof_off, row_oscillated, row_slack};
  unsigned all = 0;
  for (const RowFlag flag : flags) {
    LONGS_EQUAL(1, std::popcount(static_cast<unsigned>(flag)));
    all |= flag;
  }
  LONGS_EQUAL(flags.size(), std::popcount(all));
  LONGS_EQUAL(0, row_of({}).flags);
  const auto flags_of = [](bool Snapshot::*member) {
    Snapshot s;
    s.*member = true;
    return row_of(s).flags;
  };
  LONGS_EQUAL(row_probing, flags_of(&Snapshot::probing));
  LONGS_EQUAL(row_trusted, flags_of(&Snapshot::trusted));
  LONGS_EQUAL(row_limited, flags_of(&Snapshot::limited));
  LONGS_EQUAL(row_proof_off, flags_of(&Snapshot::proof_off));
  LONGS_EQUAL(row_slack, flags_of(&Snapshot::slack));
  Snapshot oscillating;
  oscillating.oscillation_period_s = 0.6;
  LONGS_EQUAL(row_oscillated, row_of(oscillating).flags);
}

TEST(RowOf, CopiesEachNumber) {
  struct Quantity {
    double Snapshot::*from;
    float Row::*to;
  };
  constexpr std::array quantities{
      Quantity{&Snapshot::reference, &Row::reference},
      Quantity{&Snapshot::model_m, &Row::model_m},
      Quantity{&Snapshot::position_m, &Row::position_m},
      Quantity{&Snapshot::demanded_W, &Row::demanded_W},
      Quantity{&Snapshot::applied_W, &Row::applied_W},
      Quantity{&Snapshot::duty, &Row::duty},
      Quantity{&Snapshot::supply_V, &Row::supply_V},
      Quantity{&Snapshot::current_A, &Row::current_A},
      Quantity{&Snapshot::resistance_Ohm, &Row::resistance_Ohm},
      Quantity{&Snapshot::resistance_age_s, &Row::resistance_age_s},
      Quantity{&Snapshot::coldest_C, &Row::coldest_C},
      Quantity{&Snapshot::hottest_C, &Row::hottest_C},
      Quantity{&Snapshot::error_bound, &Row::error_bound},
  };
  for (const Quantity& quantity : quantities) {
    Snapshot s;
    s.*quantity.from = 0.625;
    const Row row = row_of(s);
    for (const Quantity& other : quantities)
      CHECK((row.*other.to == 0.625F) == (other.to == quantity.to));
  }
}

TEST(RowOf, CopiesMultiplexedValues) {
  Snapshot s;
  s.progress = 0.5F;
  s.gain = {control::Gain::proportional, 0.25};
  s.margin = {2.0, 4.0, false, true};
  s.theta = {1.0, 2.0, 3.0, 4.0};
  s.bias_W = 0.125;
  s.deviation = {5.0, 6.0, 7.0, 8.0};
  s.bias_deviation_W = 9.0;
  const Row row = row_of(s);
  DOUBLES_EQUAL(0.5, row.progress, 0.0);
  LONGS_EQUAL(control::Gain::proportional, row.gain_selector);
  DOUBLES_EQUAL(0.25, row.gain, 0.0);
  DOUBLES_EQUAL(0.5, row.margin_used, 0.0);
  DOUBLES_EQUAL(2.0, row.margin_measured, 0.0);
  DOUBLES_EQUAL(4.0, row.margin_limit, 0.0);
  for (int i = 0; i < 4; ++i)
    DOUBLES_EQUAL(i + 1.0, row.theta.at(static_cast<std::size_t>(i)), 0.0);
  CHECK(std::isnan(row.multiplexed_value));
  constexpr std::array multiplexed{0.125, 5.0, 6.0, 7.0, 8.0, 9.0};
  for (const double multiplexed_value : multiplexed) {
    ++s.multiplexed_selector;
    DOUBLES_EQUAL(multiplexed_value, row_of(s).multiplexed_value, 0.0);
    LONGS_EQUAL(s.multiplexed_selector, row_of(s).multiplexed_selector);
  }
}
