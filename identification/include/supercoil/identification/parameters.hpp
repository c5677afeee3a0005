// A model's parameters, and the numbers that a fit varies.
#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "supercoil/identification/muscle.hpp"

namespace supercoil::identification {

/// Sizes of the recording, which set the parameters' units.
struct Sizes {
  double stroke_m;    ///< highest minus lowest position
  double full_W;      ///< highest power
  double duration_s;  ///< of the whole recording
  double energy_J;    ///< of the whole recording
  double step_s;      ///< between samples
  double first_m;     ///< first measured position
};

/// One fitted number, near 0 and of size 1: value = middle·exp(number), at most `max`, or
/// centre + unit·number.
struct Parameter {
  std::string_view name;  ///< Muscle's, with its unit
  double Muscle::*member;
  bool logarithmic;
  double unit;       ///< the middle if logarithmic
  double max;        ///< of the value
  double deviation;  ///< prior, of the number
  bool of_muscle;    ///< otherwise of the recording
  double centre = 0.0;
};

/// The parameters of a model; those of the recording come last.
std::vector<Parameter> parameters_of(const Effects& effects, const Sizes& sizes);

Muscle muscle_from(const std::vector<Parameter>& parameters, const Eigen::VectorXd& numbers);
Eigen::VectorXd numbers_from(const std::vector<Parameter>& parameters, const Muscle& muscle);

/// Whether the fit ended where it was limited: the true value may be beyond.
bool is_at_limit(const Parameter& parameter, double number);

/// d value / d number.
double slope(const Parameter& parameter, double number);

}  // namespace supercoil::identification
