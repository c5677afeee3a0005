#include "board/learned.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "storage/fields.hpp"

using namespace supercoil;
using namespace supercoil::storage;

TEST_GROUP(Learned){};

TEST(Learned, DefaultsAreValid) {
  CHECK_FALSE(check(board::Learned{}).has_value());
}

TEST(Learned, CheckNamesTheInvalidQuantity) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Field& field : fields) {
    for (const double bad :
         {-1e15, 1e15, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
      board::Learned set;
      field.of(set) = bad;
      const auto violation = check(set);
      CHECK_TEXT(violation.has_value(), std::string(field.key).c_str());
      STRCMP_EQUAL(std::string(field.key).c_str(), violation->quantity);
    }
  }
}

TEST(Learned, RangeLimitsAreAllowedAndValuesJustBeyondAreNot) {
  for (const Field& field : fields) {
    board::Learned set;
    field.of(set) = -1e9;
    const auto range = *check(set);
    for (const double end : {range.min, range.max}) {
      field.of(set) = end;
      CHECK_FALSE(check(set).has_value());
    }
    field.of(set) = std::nextafter(range.min, -1e300);
    CHECK(check(set).has_value());
    field.of(set) = std::nextafter(range.max, 1e300);
    CHECK(check(set).has_value());
  }
}

// A gain beyond half or twice is a mistyped meter reading, 300 K a burnt muscle, -1 W a lost sign:
// whatever wrote such a file, it must not set any bound.
TEST(Learned, ValuesImpossibleForAMuscleAndItsSensesAreRefused) {
  struct Credible {
    std::string_view key;
    double low;
    double high;
  };
  const std::vector<Credible> all{
      {"position_offset_m", -1.0, 1.0},   {"position_scale", 0.1, 10.0},
      {"cold_resistance_Ohm", 0.01, 1e4}, {"supply_gain", 0.5, 2.0},
      {"current_gain", 0.5, 2.0},         {"error_ratio", 0.0, 0.2},
      {"time_constant_s", 0.0, 1e4},      {"time_constant_at_W", 0.0, 1e3},
      {"steady_rise_K", 0.0, 300.0},      {"steady_error_K", 0.0, 100.0},
      {"steady_min_W", 0.0, 1e3},         {"steady_max_W", 0.0, 1e3}};
  for (const Credible& credible : all) {
    const auto field = std::find_if(fields.begin(), fields.end(),
                                    [&](const Field& f) { return f.key == credible.key; });
    CHECK(field != fields.end());
    for (const double end : {credible.low, credible.high}) {
      board::Learned set;
      field->of(set) = end;
      CHECK_FALSE_TEXT(check(set).has_value(), std::string(credible.key).c_str());
    }
    const double slack = 1e-6 * credible.high;
    for (const double value : {credible.low - slack, credible.high + slack}) {
      board::Learned set;
      field->of(set) = value;
      const auto violation = check(set);
      CHECK_TEXT(violation.has_value(), std::string(credible.key).c_str());
      STRCMP_EQUAL(std::string(credible.key).c_str(), violation->quantity);
    }
  }
}

TEST(Learned, SameContentIgnoresTheVersion) {
  board::Learned a;
  board::Learned b;
  b.version = 7;
  CHECK(board::same_content(a, b));
  for (const Field& field : fields) {
    board::Learned other = a;
    field.of(other) = std::nextafter(field.of(other), 1e9);
    CHECK_FALSE(board::same_content(a, other));
  }
}
