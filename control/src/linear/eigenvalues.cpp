#include "supercoil/control/linear/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace supercoil::control {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  return matrix.eigenvalues();
}

}  // namespace supercoil::control
