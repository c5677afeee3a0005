// Output-error fit: the model's own motion, from the recording's power alone, against the position.
#pragma once

#include <Eigen/Core>

#include "supercoil/identification/parameters.hpp"

namespace supercoil::identification {

struct Fit {
  Effects effects;
  std::vector<Parameter> parameters;
  Eigen::VectorXd numbers;
  Eigen::MatrixXd covariance;  ///< of the numbers, including the model's own error
  Muscle muscle;
  std::vector<double> predicted_m;  ///< at every sample of the recording, fitted or not
  double rms_m = 0.0;               ///< over the fitted samples
  double cross_validated_m = 0.0;   ///< rms over each fifth of them when the others are fitted

  /// Standard deviation of the value of parameter i.
  double deviation(std::size_t i) const;
};

/// Units of the parameters, from the whole recording.
Sizes sizes_of(const Samples& samples);

/// Levenberg-Marquardt on the measured samples within the span; the best of several starts. The
/// motion is always integrated from the recording's first row. Wide prior deviations keep
/// parameters finite that the recording does not determine.
Fit fit_model(const Effects& effects, const Samples& samples, Span span);

/// The same, starting from a fit with fewer or other effects.
Fit refit(const Muscle& start, const Effects& effects, const Samples& samples, Span span);

/// Root mean square of predicted minus measured position within the span; NaN when nothing was
/// measured there.
double rms_error(const Samples& samples, const std::vector<double>& predicted_m, Span span);

}  // namespace supercoil::identification
