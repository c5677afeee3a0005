// Eigenvalues of a matrix of any size.
#pragma once

#include <Eigen/Core>

namespace supercoil::control {

/// Compiled once, for all sizes: Eigen's solver takes 10 s for each fixed size.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace supercoil::control
