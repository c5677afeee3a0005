#include <Eigen/Eigenvalues>

#include "supercoil/control/linear/matrix_functions.hpp"

namespace supercoil::control {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  return matrix.eigenvalues();
}

}  // namespace supercoil::control
