// Fixed as the scalar of Eigen's vectors and matrices.
#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "supercoil/control/scalar/scalar.hpp"

#include "unit/control/support/generators.hpp"

using namespace supercoil::control;
using supercoil::test::reals;

namespace {

template <int Rows, int Columns>
Matrix<Q8_24, Rows, Columns> random_matrix(double size) {
  Matrix<Q8_24, Rows, Columns> result;
  for (int i = 0; i < Rows; ++i) {
    for (int j = 0; j < Columns; ++j)
      result(i, j) = Q8_24{*reals(-size, size)};
  }
  return result;
}

constexpr double place = 1.0 / (1 << 24);

}  // namespace

TEST_GROUP(FixedEigen){};

TEST(FixedEigen, DotProductIsWithinHalfAPlaceForEachTerm) {
  CHECK(rc::check("dot", [] {
    const auto a = random_matrix<6, 1>(4.0);
    const auto b = random_matrix<6, 1>(4.0);
    // Products of 31 bits and sums of six are exact in a double.
    const double exact = a.cast<double>().dot(b.cast<double>());
    RC_ASSERT(std::abs(static_cast<double>(a.dot(b)) - exact) <= 6 * 0.5 * place);
  }));
}

TEST(FixedEigen, MatrixProductIsWithinHalfAPlaceForEachTerm) {
  CHECK(rc::check("product", [] {
    const auto a = random_matrix<4, 4>(4.0);
    const auto b = random_matrix<4, 4>(4.0);
    const Matrix<double, 4> exact = a.cast<double>() * b.cast<double>();
    const Matrix<Q8_24, 4> product = a * b;
    RC_ASSERT((product.cast<double>() - exact).cwiseAbs().maxCoeff() <= 4 * 0.5 * place);
  }));
}

TEST(FixedEigen, DotProductSaturates) {
  const Vector<Q8_24, 3> a = Vector<Q8_24, 3>::Constant(Q8_24{10});
  CHECK(a.dot(a) == Q8_24::max());
  CHECK(a.dot(-a) == Q8_24::min());
}

TEST(FixedEigen, CoefficientwiseLimitsAreThoseOfTheScalars) {
  const Vector<Q8_24, 2> value{Q8_24{-5}, Q8_24{7}};
  const Vector<Q8_24, 2> limit{Q8_24{-1}, Q8_24{2}};
  CHECK((value.cwiseMax(limit) == Vector<Q8_24, 2>{Q8_24{-1}, Q8_24{7}}));
  CHECK((value.cwiseMin(limit) == Vector<Q8_24, 2>{Q8_24{-5}, Q8_24{2}}));
  CHECK(value.cwiseAbs().maxCoeff() == Q8_24{7});
}

TEST(FixedEigen, CastsToItsAccumulatorAndBackWithoutLoss) {
  CHECK(rc::check("casts", [] {
    const auto a = random_matrix<6, 1>(100.0);
    const Vector<Q16_48, 6> wide = a.cast<Accumulator<Q8_24>>();
    RC_ASSERT((wide.cast<Q8_24>() == a));
  }));
}
