#include "supercoil/control/linear/discretize.hpp"

#include <CppUTest/TestHarness.h>

#include "unit/control/support/reference.hpp"

using namespace supercoil::control;
using supercoil::test::matrix_from;

namespace {

using A = Matrix<double, 3>;
using B = Matrix<double, 3, 2>;

/// The largest difference relative to the largest element.
template <class M>
double difference(const M& actual, const M& expected) {
  return (actual - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_GROUP(Discretize) {
  const nlohmann::json cases = supercoil::test::reference("linear", "holds");
};

TEST(Discretize, ZeroOrderHoldAgreesWithScipy) {
  for (const auto& c : cases) {
    const auto result =
        zero_order_hold<3, 2>(matrix_from<A>(c.at("a")), matrix_from<B>(c.at("b")), c.at("step_s"));
    CHECK(difference<A>(result.transition, matrix_from<A>(c.at("zoh").at("transition"))) < 1e-12);
    CHECK(difference<B>(result.held, matrix_from<B>(c.at("zoh").at("held"))) < 1e-11);
  }
}

TEST(Discretize, FirstOrderHoldIsTheSolutionForAStraightLine) {
  for (const auto& c : cases) {
    const auto result = first_order_hold<3, 2>(matrix_from<A>(c.at("a")), matrix_from<B>(c.at("b")),
                                               c.at("step_s"));
    const auto& foh = c.at("foh");
    CHECK(difference<A>(result.transition, matrix_from<A>(foh.at("transition"))) < 1e-9);
    CHECK(difference<B>(result.start, matrix_from<B>(foh.at("start"))) < 1e-9);
    CHECK(difference<B>(result.end, matrix_from<B>(foh.at("end"))) < 1e-9);
  }
}

TEST(Discretize, HoldsAgreeWhileTheInputIsConstant) {
  for (const auto& c : cases) {
    const A a = matrix_from<A>(c.at("a"));
    const B b = matrix_from<B>(c.at("b"));
    const auto zero = zero_order_hold<3, 2>(a, b, c.at("step_s"));
    const auto first = first_order_hold<3, 2>(a, b, c.at("step_s"));
    CHECK(difference<B>(first.start + first.end, zero.held) < 1e-11);
  }
}
