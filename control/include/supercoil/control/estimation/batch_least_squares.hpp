// One fit to a whole experiment.
#pragma once

#include <cstdint>
#include <optional>

#include "supercoil/control/estimation/parametric_model.hpp"

namespace supercoil::control {

/// Sums the regression z = θᵀφ (paper, Eq. (3)) over an experiment and solves it at the end: every
/// sample counts alike, and nothing has to converge. Fits to the first part of the experiment, and
/// judges the fit by the last part, which it has not seen.
class BatchLeastSquares {
 public:
  struct Settings {
    Polynomial<3> lambda = paper_lambda;
    RegressionScale scale;
    double settle_s = 6.0;    ///< not used: the filters start at rest, the muscle perhaps not
    double fit_part = 0.667;  ///< of what is used
  };
  struct Fit {
    Theta theta;                  ///< in θ's own units
    double relative_error_bound;  ///< of all parameters together, from the part that was not fitted
    double unexplained_part;      ///< of the filtered power's energy there
  };

  /// duration_s: of the whole experiment, > settle_s.
  BatchLeastSquares(const Settings& settings, double duration_s, double step_s);

  /// One tick: this tick's position, and the power applied since the last one.
  void step(double position_m, double applied_power_W);
  /// Empty when the motion was not rich enough for a solution.
  std::optional<Fit> fit() const;

 private:
  struct Sums {
    Matrix<double, 4> information = Matrix<double, 4>::Zero();
    Vector<double, 4> correlation = Vector<double, 4>::Zero();
    double energy = 0.0;
  };

  Settings settings_;
  double step_s_;
  std::int64_t tick_ = 0;
  std::int64_t first_tick_;
  std::int64_t fit_until_;
  ParametricModel<double> model_;
  Sums fitted_;
  Sums unseen_;
};

}  // namespace supercoil::control
