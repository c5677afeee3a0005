#include "supercoil/control/linear/polynomial.hpp"

#include <limits>

#include <CppUTest/TestHarness.h>

#include "unit/control/support/reference.hpp"

using namespace supercoil::control;

namespace {

bool is_hurwitz_of_any_degree(const std::vector<double>& c) {
  const auto fixed = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
    Polynomial<N> p{};
    std::copy(c.begin(), c.end(), p.begin());
    return is_hurwitz<N>(p);
  };
  switch (c.size()) {
    case 3:
      return fixed(std::integral_constant<std::size_t, 2>{});
    case 4:
      return fixed(std::integral_constant<std::size_t, 3>{});
    case 5:
      return fixed(std::integral_constant<std::size_t, 4>{});
    default:
      return fixed(std::integral_constant<std::size_t, 5>{});
  }
}

PositiveRealness realness_of(const nlohmann::json& c) {
  return positive_realness(c.at("numerator").get<Polynomial<2>>(),
                           c.at("denominator").get<Polynomial<3>>());
}

}  // namespace

TEST_GROUP(Polynomials){};

TEST(Polynomials, RouthsTestAgreesWithNumpysRoots) {
  const auto cases = supercoil::test::reference("linear", "hurwitz");
  CHECK(cases.size() > 700);
  for (const auto& c : cases) {
    const bool expected = c.at("hurwitz");
    CHECK_EQUAL_TEXT(expected,
                     is_hurwitz_of_any_degree(c.at("ascending").get<std::vector<double>>()),
                     c.dump().c_str());
  }
}

TEST(Polynomials, MarginalStabilityANaNOrANegativeLeadIsNotHurwitz) {
  CHECK_FALSE((is_hurwitz<2>({1.0, 0.0, 1.0})));
  CHECK_FALSE((is_hurwitz<2>({0.0, 1.0, 1.0})));
  CHECK_FALSE((is_hurwitz<3>({1.0, 1.0, 1.0, 1.0})));  // (s² + 1)(s + 1)
  CHECK_FALSE((is_hurwitz<2>({-1.0, -2.0, -1.0})));
  for (std::size_t i = 0; i < 4; ++i) {
    Polynomial<3> p{6.0, 11.0, 6.0, 1.0};
    CHECK(is_hurwitz<3>(p));
    p[i] = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(is_hurwitz<3>(p));
  }
}

TEST(Polynomials, PositiveRealnessAgreesWithASweepOverFrequency) {
  for (const auto& c : supercoil::test::reference("linear", "realness")) {
    const PositiveRealness result = realness_of(c);
    const bool expected = c.at("strict");
    CHECK_EQUAL_TEXT(expected, result.strict(), c.dump().c_str());
    if (c.at("min_real_part").is_null()) {
      CHECK_FALSE(result.high_frequency);
      CHECK(result.min_real_part < 0.0);
    } else {
      const double swept = c.at("min_real_part");
      DOUBLES_EQUAL(swept, result.min_real_part, 1e-4 * (1.0 + std::abs(swept)));
      CHECK(result.min_real_part <= swept + 1e-12);  // a sweep can only miss the minimum
    }
  }
}

TEST(Polynomials, AnUnstableDenominatorIsNeverStrictlyPositiveReal) {
  // (s + 1)²/(s − 1)(s + 1)² has a positive real part nowhere, its mirror image everywhere.
  CHECK_FALSE(positive_realness({1.0, 2.0, 1.0}, {-1.0, -1.0, 1.0, 1.0}).strict());
  CHECK(positive_realness({1.0, 2.0, 1.0}, {1.0, 3.0, 3.0, 1.0}).strict());
}
