// Functions of matrices, each compiled once for all sizes.
#pragma once

#include <span>

#include <Eigen/Core>

namespace supercoil::control {

/// The largest matrix that it takes.
inline constexpr int max_exponential_size = 9;

/// Replaces the size×size matrix by its exponential; columns lie one after the other.
///
/// Padé approximation with scaling and squaring (Higham 2005), as Eigen's MatrixBase::exp(): to the
/// bit, in one function for all sizes. Eigen's takes 40 s to compile for the eight sizes in use,
/// and its instance of variable size adds in another order than those of fixed size.
void replace_by_exponential(std::span<double> matrix, int size);

/// Of a square matrix of any size; Eigen's solver takes 10 s to compile for each fixed size.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace supercoil::control
