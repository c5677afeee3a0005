// Functions of matrices, each compiled once for all sizes.
#pragma once

#include <span>

#include <Eigen/Core>

namespace supercoil::control {

/// The largest size that replace_by_exponential() takes.
inline constexpr int max_exponential_size = 9;

/// Replaces the size×size matrix, stored column by column, by its exponential.
///
/// Padé approximation with scaling and squaring (Higham 2005). Bit-identical to Eigen's
/// MatrixBase::exp(), but one function for all sizes: Eigen's takes 40 s to compile for the eight
/// sizes in use, and its dynamic-size instance adds in a different order from the fixed-size ones.
void replace_by_exponential(std::span<double> matrix, int size);

/// For a square matrix of any size; Eigen's solver takes 10 s to compile for each fixed size.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace supercoil::control
