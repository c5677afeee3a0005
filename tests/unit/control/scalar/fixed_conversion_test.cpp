#include <algorithm>
#include <cmath>
#include <limits>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "supercoil/control/scalar/fixed.hpp"

#include "unit/control/support/generators.hpp"

using namespace supercoil::control;
using supercoil::test::fixed_numbers;
using supercoil::test::reals;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// |F(value) − value| in units of the last place; long double holds both exactly.
template <class F>
long double error_in_places(double value) {
  return std::fabs(static_cast<long double>(F{value}.raw()) -
                   std::ldexp(static_cast<long double>(value), F::fraction_bits));
}

}  // namespace

TEST_GROUP(FixedConversion){};

TEST(FixedConversion, FromDoubleIsWithinHalfAPlace) {
  CHECK(rc::check("q8.24", [] {
    const double value = *reals(-127.9, 127.9) * *reals(0.0, 1.0);
    RC_ASSERT(error_in_places<Q8_24>(value) <= 0.5L);
  }));
  CHECK(rc::check("q16.48", [] {
    const double value = *reals(-32767.0, 32767.0) * *reals(0.0, 1.0);
    RC_ASSERT(error_in_places<Q16_48>(value) <= 0.5L);
  }));
}

TEST(FixedConversion, FromDoubleRoundsTiesAwayFromZero) {
  const double place = std::ldexp(1.0, -24);
  LONGS_EQUAL(1, Q8_24{0.5 * place}.raw());
  LONGS_EQUAL(-1, Q8_24{-0.5 * place}.raw());
  LONGS_EQUAL(3, Q8_24{2.5 * place}.raw());
  LONGS_EQUAL(0, Q8_24{0.499 * place}.raw());
}

TEST(FixedConversion, Q8_24RoundTripsThroughDoubleAndQ16_48) {
  CHECK(rc::check("round trips", [] {
    const auto value = *fixed_numbers<Q8_24>();
    RC_ASSERT(Q8_24{static_cast<double>(value)} == value);
    RC_ASSERT(Q8_24{Q16_48{value}} == value);
  }));
}

TEST(FixedConversion, ValuesOutOfRangeSaturate) {
  CHECK(Q8_24{128.0} == Q8_24::max());
  CHECK(Q8_24{-128.0} == Q8_24::min());
  CHECK(Q8_24{-128.1} == Q8_24::min());
  CHECK(Q8_24{1e300} == Q8_24::max());
  CHECK(Q8_24{infinity} == Q8_24::max());
  CHECK(Q8_24{-infinity} == Q8_24::min());
  CHECK(Q8_24{std::numeric_limits<float>::infinity()} == Q8_24::max());
  CHECK(Q16_48{32768.0} == Q16_48::max());
  CHECK(Q16_48{-infinity} == Q16_48::min());
  CHECK(Q8_24{128} == Q8_24::max());
  CHECK(Q8_24{std::numeric_limits<int>::min()} == Q8_24::min());
  CHECK(Q16_48{std::numeric_limits<int>::max()} == Q16_48::max());
}

TEST(FixedConversion, NaNBecomesZero) {
  CHECK(Q8_24{not_a_number} == Q8_24{});
  CHECK(Q16_48{-not_a_number} == Q16_48{});
}

TEST(FixedConversion, NarrowingRoundsToNearestWithTiesUpwardAndSaturates) {
  CHECK(rc::check("q16.48 to q8.24", [] {
    const auto wide = *fixed_numbers<Q16_48>();
    const Q8_24 narrow{wide};
    const auto place = detail::Int128{1} << 24;
    const auto rest = wide.raw() - narrow.raw() * place;
    if (narrow == Q8_24::max()) {
      RC_ASSERT(rest >= -place / 2);
    } else if (narrow == Q8_24::min()) {
      RC_ASSERT(rest < place / 2);
    } else {
      RC_ASSERT(rest >= -place / 2);
      RC_ASSERT(rest < place / 2);
    }
  }));
  CHECK(Q8_24{Q16_48{1000.0}} == Q8_24::max());
  CHECK(Q8_24{Q16_48{-1000.0}} == Q8_24::min());
}

TEST(FixedConversion, WideningToFewerIntegerBitsSaturates) {
  CHECK((Fixed<2, 62>{Q8_24{3.0}} == Fixed<2, 62>::max()));
  CHECK((Fixed<2, 62>{Q8_24{-3.0}} == Fixed<2, 62>::min()));
  CHECK((static_cast<double>(Fixed<2, 62>{Q8_24{1.5}}) == 1.5));
}

TEST(FixedConversion, KeepsTheOrder) {
  CHECK(rc::check("monotony", [] {
    const auto [low, high] = std::minmax({*reals(-200.0, 200.0), *reals(-200.0, 200.0)});
    RC_ASSERT(Q8_24{low} <= Q8_24{high});
    const auto [a, b] = std::minmax({*fixed_numbers<Q16_48>(), *fixed_numbers<Q16_48>()});
    RC_ASSERT(Q8_24{a} <= Q8_24{b});
    RC_ASSERT(static_cast<double>(a) <= static_cast<double>(b));
  }));
}

TEST(FixedConversion, ToIntTruncatesTowardZero) {
  LONGS_EQUAL(3, static_cast<int>(Q8_24{3.99}));
  LONGS_EQUAL(-3, static_cast<int>(Q8_24{-3.99}));
}
