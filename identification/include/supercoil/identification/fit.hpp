// Output-error fit: the model's own motion, from the recording's power alone, against the position.
#pragma once

#include <Eigen/Core>

#include "supercoil/identification/parameters.hpp"

namespace supercoil::identification {

struct Fit {
  Effects effects;
  std::vector<Parameter> parameters;
  Eigen::VectorXd numbers;
  Eigen::MatrixXd covariance;  ///< of the numbers, the model's own error included
  Muscle muscle;
  std::vector<double> predicted_m;  ///< at every sample of the recording, fitted or not
  double rms_m = 0.0;               ///< of what was fitted
  double cross_validated_m = 0.0;   ///< of each fifth of it, when the others were fitted

  /// Standard, of the value of parameter i.
  double deviation(std::size_t i) const;
};

/// Sizes that parameters are counted in. Of the whole recording.
Sizes sizes_of(const Samples& samples);

/// Levenberg-Marquardt on the samples within the span that were measured, from the best of several
/// starts. The motion is always integrated from the recording's first row. The parameters' wide
/// prior deviations keep finite what the recording does not determine.
Fit fit_model(const Effects& effects, const Samples& samples, Span span);

/// The same from a fit with fewer or other effects.
Fit refit(const Muscle& start, const Effects& effects, const Samples& samples, Span span);

/// Root mean square of predicted less measured position within the span; NaN when nothing was
/// measured there.
double rms_error(const Samples& samples, const std::vector<double>& predicted_m, Span span);

}  // namespace supercoil::identification
