// How far off fitted parameters are, when the model itself is not exact.
#pragma once

#include <Eigen/Core>

namespace supercoil::identification {

struct Accuracy {
  Eigen::MatrixXd covariance;    ///< of the parameters
  double cross_validated = 0.0;  ///< rms residual of each stretch when the others are fitted
};

/// The residuals of a model that is not exact are not white noise: they are correlated over
/// seconds. So two covariances are added:
/// - twice the delete-a-block jackknife, linearised: how far the solution moves when each of five
///   stretches of the recording is left out;
/// - the least-squares covariance, with the residuals' variance counted once for each stretch over
///   which they are correlated, and the prior deviations.
/// jacobian: samples × parameters, of the residuals; rows in the order of time. The parameters,
/// near their best, have 0 as their prior mean.
Accuracy accuracy_of(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                     const Eigen::VectorXd& numbers, const Eigen::VectorXd& prior);

/// The residuals' variance times correlated_samples(): the variance that one sample counts with.
double counted_variance(const Eigen::VectorXd& residual, Eigen::Index parameters);

/// Samples over which residuals are correlated: 1 + 2 Σ of their autocorrelation, until it is below
/// 0.05 or a tenth of all is reached. At least 1.
double correlated_samples(const Eigen::VectorXd& residual);

}  // namespace supercoil::identification
