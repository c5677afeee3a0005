// The parameters of a model as the numbers that a fit moves.
#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "supercoil/identification/muscle.hpp"

namespace supercoil::identification {

/// What the recording's own size makes of a parameter's unit.
struct Sizes {
  double stroke_m;    ///< highest less lowest position
  double full_W;      ///< highest power
  double duration_s;  ///< of the whole recording
  double energy_J;    ///< of the whole recording
  double step_s;      ///< between samples
};

/// One number that is fitted, near 0 and of size 1: value = middle·exp(number), highest at most, or
/// unit·number.
struct Parameter {
  std::string_view name;  ///< Muscle's, with its unit
  double Muscle::*member;
  bool logarithmic;
  double unit;       ///< middle, where it is logarithmic
  double highest;    ///< value
  double deviation;  ///< of the number, before any data
  bool of_muscle;    ///< else of the recording
};

/// Those of a model, the recording's own last.
std::vector<Parameter> parameters_of(const Effects& effects, const Sizes& sizes);

Muscle muscle_from(const std::vector<Parameter>& parameters, const Eigen::VectorXd& numbers);
Eigen::VectorXd numbers_from(const std::vector<Parameter>& parameters, const Muscle& muscle);

/// d value / d number.
double slope(const Parameter& parameter, double number);

}  // namespace supercoil::identification
