#include "board/learned.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "storage/fields.hpp"

using namespace supercoil;
using namespace supercoil::storage;

namespace {

struct Documented {
  std::string key;
  double min;
  double max;
};

/// The rows of the table in docs/storage.md: "| `a`, `b` | 0 to 10 | … |".
std::vector<Documented> documented_ranges() {
  std::ifstream page(SUPERCOIL_DOCS "/storage.md");
  std::vector<Documented> all;
  std::string line;
  while (std::getline(page, line) && line != "| key | range | meaning |") {
  }
  std::getline(page, line);
  while (std::getline(page, line) && line.starts_with("| `")) {
    const std::size_t end = line.find(" | ");
    double min = NAN;
    double max = NAN;
    std::sscanf(line.c_str() + end, " | %lf to %lf |", &min, &max);
    for (std::size_t from = line.find('`'); from < end; from = line.find('`', from + 1)) {
      const std::size_t to = line.find('`', from + 1);
      all.push_back({line.substr(from + 1, to - from - 1), min, max});
      from = to;
    }
  }
  return all;
}

}  // namespace

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
  const std::vector<Documented> all = documented_ranges();
  for (const Field& field : fields) {
    const auto of_docs = std::ranges::find(all, field.key, &Documented::key);
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
