#include <cmath>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>

#include <CppUTest/TestHarness.h>
#include <Eigen/LU>

#include "supercoil/control/linear/matrix_functions.hpp"
#include "supercoil/control/scalar/scalar.hpp"

using supercoil::control::Matrix;

namespace {

/// Norms from 1e-5 to 1e3, so that every approximation is used; some with zeros or zero last rows,
/// as holds have.
class Matrices {
 public:
  template <int Size>
  Matrix<double, Size> next() {
    const double scale = std::pow(10.0, between(-5.0, 2.0));
    const double zeros = between(-1.0, 1.0);
    const int empty_rows = static_cast<int>(between(0.0, 3.0));
    Matrix<double, Size> matrix = Matrix<double, Size>::Zero();
    for (int row = 0; row < Size - empty_rows; ++row) {
      for (int column = 0; column < Size; ++column) {
        if (between(0.0, 1.0) > zeros)
          matrix(row, column) = scale * between(-1.0, 1.0) * std::pow(10.0, between(-2.0, 2.0));
      }
    }
    return matrix;
  }

 private:
  double between(double from, double to) {
    return std::uniform_real_distribution(from, to)(generator_);
  }

  std::mt19937_64 generator_{20261123};
};

template <int Size>
int differing_matrices() {
  Matrices matrices;
  int differing = 0;
  for (int i = 0; i < 2000; ++i) {
    Matrix<double, Size> actual = matrices.next<Size>();
    const Matrix<double, Size> expected = actual.exp();
    supercoil::control::replace_by_exponential({actual.data(), Size * Size}, Size);
    for (int k = 0; k < Size * Size; ++k) {
      if (actual.data()[k] != expected.data()[k] &&
          !(std::isnan(actual.data()[k]) && std::isnan(expected.data()[k]))) {
        ++differing;
        break;
      }
    }
  }
  return differing;
}

}  // namespace

TEST_GROUP(MatrixExponential){};

// These of the sizes in use cover every order of summation; Eigen's takes 3 s a size to compile.
TEST(MatrixExponential, MatchesEigenToTheBit) {
  LONGS_EQUAL(0, differing_matrices<3>());
  LONGS_EQUAL(0, differing_matrices<5>());
  LONGS_EQUAL(0, differing_matrices<8>());
  LONGS_EQUAL(0, differing_matrices<9>());
}
