#include "board/learned.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <CppUTest/TestHarness.h>

#include "storage/fields.hpp"
#include "support/documented_ranges.hpp"

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
TEST(Learned, RangesAreThoseOfTheDocs) {
  const auto all = test::documented_ranges(SUPERCOIL_DOCS "/storage.md");
  for (const Field& field : fields) {
    const auto of_docs = std::ranges::find(all, field.key, &test::DocumentedRange::key);
    const std::string key(field.key);
    CHECK_EQUAL_TEXT(field.table != "muscle", of_docs != all.end(), key.c_str());
    if (of_docs == all.end()) continue;
    for (const double end : {of_docs->min, of_docs->max}) {
      board::Learned set;
      field.of(set) = end;
      CHECK_FALSE_TEXT(check(set).has_value(), key.c_str());
    }
    for (const double beyond :
         {std::nextafter(of_docs->min, -1e300), std::nextafter(of_docs->max, 1e300)}) {
      board::Learned set;
      field.of(set) = beyond;
      const auto violation = check(set);
      CHECK_TEXT(violation.has_value(), key.c_str());
      STRCMP_EQUAL(key.c_str(), violation->quantity);
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
