#include <algorithm>
#include <string>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "supercoil/control/scalar/fixed.hpp"

#include "unit/control/support/generators.hpp"

using namespace supercoil::control;
using supercoil::test::fixed_numbers;

namespace {

using Integer = detail::Int128;

template <class F>
constexpr Integer one = Integer{1} << F::fraction_bits;

template <class F>
bool fits(Integer raw) {
  return raw >= F::min().raw() && raw <= F::max().raw();
}

/// A property of two numbers, in both formats.
template <class Property>
bool holds_for_two(const char* name, Property property) {
  return rc::check(std::string(name) + ", q8.24",
                   [&] {
                     const auto a = *fixed_numbers<Q8_24>();
                     const auto b = *fixed_numbers<Q8_24>();
                     property(a, b);
                   }) &&
         rc::check(std::string(name) + ", q16.48", [&] {
           const auto a = *fixed_numbers<Q16_48>();
           const auto b = *fixed_numbers<Q16_48>();
           property(a, b);
         });
}

/// result must be the limit if the exact value is above or below, and otherwise satisfy right().
template <class F, class Right>
void expect(F result, bool above, bool below, Right right) {
  if (above) {
    RC_ASSERT(result == F::max());
  } else if (below) {
    RC_ASSERT(result == F::min());
  } else {
    RC_ASSERT(right());
  }
}

}  // namespace

TEST_GROUP(FixedArithmetic){};

TEST(FixedArithmetic, SumIsExactOrSaturates) {
  CHECK(holds_for_two("sum", []<class F>(F a, F b) {
    const Integer exact = Integer{a.raw()} + b.raw();
    expect(a + b, exact > F::max().raw(), exact < F::min().raw(),
           [&] { return (a + b).raw() == exact; });
  }));
}

TEST(FixedArithmetic, DifferenceIsExactOrSaturates) {
  CHECK(holds_for_two("difference", []<class F>(F a, F b) {
    const Integer exact = Integer{a.raw()} - b.raw();
    expect(a - b, exact > F::max().raw(), exact < F::min().raw(),
           [&] { return (a - b).raw() == exact; });
  }));
}

TEST(FixedArithmetic, ProductIsTheNearestWithTiesUpwardOrSaturates) {
  CHECK(holds_for_two("product", []<class F>(F a, F b) {
    const Integer exact = Integer{a.raw()} * b.raw();  // in units of one<F>
    const Integer half = one<F> / 2;
    // It must saturate when even the nearest number lies outside.
    const bool above = exact - Integer{F::max().raw()} * one<F> >= half;
    const bool below = Integer{F::min().raw()} * one<F> - exact > half;
    expect(a * b, above, below, [&] {
      const Integer rest = exact - Integer{(a * b).raw()} * one<F>;
      return rest >= -half && rest < half;
    });
  }));
}

TEST(FixedArithmetic, QuotientIsTheNearestWithTiesAwayFromZeroOrSaturates) {
  CHECK(holds_for_two("quotient", []<class F>(F a, F b) {
    RC_PRE(b != F{});
    const Integer dividend = Integer{a.raw()} * one<F>;
    const Integer divisor = b.raw();
    const Integer size = divisor < 0 ? -divisor : divisor;
    const Integer quotient = (a / b).raw();
    const Integer rest = dividend - quotient * divisor;
    const Integer off = rest < 0 ? -rest : rest;
    if (quotient == F::max().raw() || quotient == F::min().raw()) {
      // A limit is right when the true quotient lies beyond it or within half a step.
      const bool positive = (dividend < 0) == (divisor < 0);
      RC_ASSERT(positive == (quotient > 0));
      const Integer true_size = dividend < 0 ? -dividend : dividend;
      const Integer limit_size = quotient < 0 ? -quotient : quotient;
      RC_ASSERT(2 * true_size >= (2 * limit_size - 1) * size);
    } else {
      RC_ASSERT(2 * off <= size);
      // A tie was rounded away from zero: the remainder then points back.
      if (2 * off == size) RC_ASSERT((rest < 0) != (dividend < 0));
    }
  }));
}

TEST(FixedArithmetic, DivisionByZeroSaturatesWithTheDividendsSign) {
  CHECK(Q8_24{1.0} / Q8_24{} == Q8_24::max());
  CHECK(Q8_24{-1.0} / Q8_24{} == Q8_24::min());
  CHECK(Q8_24{} / Q8_24{} == Q8_24{});
  CHECK(Q16_48::resolution() / Q16_48{} == Q16_48::max());
}

TEST(FixedArithmetic, OperationsKeepTheOrderOfTheirOperands) {
  CHECK(holds_for_two("monotony", []<class F>(F a, F b) {
    const auto c = *fixed_numbers<F>();
    const auto [low, high] = std::minmax(a, b);
    RC_ASSERT(low + c <= high + c);
    RC_ASSERT(c - low >= c - high);
    if (c > F{}) {
      RC_ASSERT(low * c <= high * c);
      RC_ASSERT(low / c <= high / c);
    }
  }));
}

TEST(FixedArithmetic, RootIsTheNearest) {
  CHECK(holds_for_two("root", []<class F>(F a, F) {
    const Integer root = sqrt(a).raw();
    if (a <= F{}) {
      RC_ASSERT(root == 0);
      return;
    }
    const Integer radicand = Integer{a.raw()} * one<F>;
    RC_ASSERT(4 * radicand >= (2 * root - 1) * (2 * root - 1));
    RC_ASSERT(4 * radicand <= (2 * root + 1) * (2 * root + 1));
  }));
}

TEST(FixedArithmetic, TheLowestNumberHasALargestMagnitudeNotANegativeOne) {
  CHECK(abs(Q8_24::min()) == Q8_24::max());
  CHECK(-Q8_24::min() == Q8_24::max());
  CHECK(abs(Q16_48::min()) == Q16_48::max());
  CHECK(-Q8_24::max() == Q8_24::from_raw(Q8_24::min().raw() + 1));
  CHECK(Q8_24::min() * Q8_24::min() == Q8_24::max());
  CHECK(Q16_48::min() / Q16_48{-1} == Q16_48::max());
}

TEST(FixedArithmetic, AtLimitReportsPossibleSaturation) {
  CHECK((Q8_24{100} + Q8_24{100}).at_limit());
  CHECK((Q8_24{-100} - Q8_24{100}).at_limit());
  CHECK_FALSE((Q8_24{100} + Q8_24{27}).at_limit());
}
