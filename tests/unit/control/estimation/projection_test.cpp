#include "supercoil/control/estimation/projection.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil::control;

namespace {

const Box<double, 2> unit_box{{0.0, 0.0}, {1.0, 1.0}};

}  // namespace

TEST_GROUP(Projection){};

TEST(Projection, PointsInsideStayUnchanged) {
  const Vector<double, 2> inside{0.3, 1.0};
  const Matrix<double, 2> covariance{{1.0, 0.9}, {0.9, 1.0}};
  CHECK((project<2>(inside, unit_box, covariance) - inside).norm() == 0.0);
}

TEST(Projection, CorrelatedParametersMoveTogether) {
  // Their sum is known: when one decreases, the other increases.
  const Matrix<double, 2> covariance{{1.0, -1.0}, {-1.0, 1.0}};
  const Vector<double, 2> found = project<2>(Vector<double, 2>{1.4, 0.2}, unit_box, covariance);
  DOUBLES_EQUAL(1.0, found[0], 1e-12);
  DOUBLES_EQUAL(0.6, found[1], 1e-12);
}

TEST(Projection, IndependentParametersMoveToTheirBounds) {
  const Matrix<double, 2> covariance = Matrix<double, 2>::Identity();
  const Vector<double, 2> found = project<2>(Vector<double, 2>{1.4, -3.0}, unit_box, covariance);
  CHECK((found - Vector<double, 2>{1.0, 0.0}).norm() < 1e-12);
}

TEST(Projection, EndsInsideForAnyCovariance) {
  const Box<double, 3> box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  const Matrix<double, 3> root{{1.0, 0.0, 0.0}, {-5.0, 0.1, 0.0}, {3.0, -2.0, 0.0}};
  const Vector<double, 3> found =
      project<3>(Vector<double, 3>{1.5, 2.0, -1.0}, box, root * root.transpose());
  CHECK(box.contains(found));
}
