#include "storage/learned.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <CppUTest/TestHarness.h>

#include "storage/fields.hpp"

using namespace supercoil::storage;

TEST_GROUP(Learned){};

TEST(Learned, DefaultsAreValid) {
  CHECK_FALSE(check(Learned{}).has_value());
}

TEST(Learned, CheckNamesTheQuantityThatIsWrong) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Field& field : fields) {
    for (const double bad :
         {-1e15, 1e15, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
      Learned set;
      field.of(set) = bad;
      const auto violation = check(set);
      CHECK_TEXT(violation.has_value(), std::string(field.key).c_str());
      STRCMP_EQUAL(std::string(field.key).c_str(), violation->quantity);
    }
  }
}

TEST(Learned, TheEndsOfARangeAreAllowedAndWhatLiesJustBeyondIsNot) {
  for (const Field& field : fields) {
    Learned set;
    field.of(set) = -1e9;
    const auto range = *check(set);
    for (const double end : {range.lowest, range.highest}) {
      field.of(set) = end;
      CHECK_FALSE(check(set).has_value());
    }
    field.of(set) = std::nextafter(range.lowest, -1e300);
    CHECK(check(set).has_value());
    field.of(set) = std::nextafter(range.highest, 1e300);
    CHECK(check(set).has_value());
  }
}

TEST(Learned, ContentIsTheSameWhateverTheVersion) {
  Learned a;
  Learned b;
  b.version = 7;
  CHECK(same_content(a, b));
  for (const Field& field : fields) {
    Learned other = a;
    field.of(other) = std::nextafter(field.of(other), 1e9);
    CHECK_FALSE(same_content(a, other));
  }
}
