// One fit to a whole experiment.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/estimation/parametric_model.hpp"

namespace supercoil::control {

/// Sums the regression P/Λ = θᵀ[m̂s³X, s²X, sX, X]/Λ + bias over an experiment, block by block, and
/// solves it at the end: every sample counts alike, and nothing has to converge.
///
/// It is an instrumental-variable fit: the regressors contain the noise of the measured position,
/// so they are correlated with those of a simulation of the believed muscle under the same power,
/// which has no noise. Noise then widens the result but does not bias it. Errors of the believed
/// muscle matter little: it only weights the samples.
///
/// The deviation of each parameter is the jackknife's over the blocks (Efron and Stein, 1981): how
/// much the result depends on which part of the experiment is left out. So it includes the noise,
/// and as much of the model's own error as varies during the experiment.
class BatchLeastSquares {
  static constexpr int size = 5;  ///< θ and the bias
  using Regressors = Vector<double, size>;

 public:
  static constexpr std::size_t max_blocks = 16;
  /// Fewer would leave nothing to judge the fit by.
  static constexpr std::size_t min_blocks = 3;

  /// What the experiment says about the muscle.
  struct Fit {
    Theta theta;      ///< in θ's own units, from all blocks
    double bias_W;    ///< constant power beside them: a load, a wrong zero
    Theta deviation;  ///< standard, relative to theta
    /// Distance of the last third's fit from the fit of the rest, which has not seen the last
    /// third, relative to the latter.
    Theta holdout_difference;
    /// Fraction of the filtered power's variance in the last third that the fit of the rest does
    /// not explain.
    double unexplained_ratio;
  };

  /// step_s: between ticks. believed: a valid muscle.
  BatchLeastSquares(const PhysicalParameters& believed, double step_s);

  /// Forgets everything. The muscle is at rest at this position, without power.
  void start(double position_m);

  /// Begins another experiment while the motion continues.
  void restart();

  /// One tick: this tick's position, and the power applied since the last one. block: which one the
  /// tick counts to, below max_blocks; empty while the filters settle.
  void step(double position_m, double applied_power_W, std::optional<std::size_t> block);

  /// The number of blocks that have begun.
  std::size_t blocks() const { return blocks_; }

  /// Empty when there are too few blocks or the motion was not rich enough for a solution. The
  /// last block counts as complete.
  std::optional<Fit> fit() const;

  /// The sums that a fit needs of an experiment.
  class Sums {
    friend BatchLeastSquares;
    Matrix<double, size> instrumental = Matrix<double, size>::Zero();
    Regressors correlation = Regressors::Zero();
    // To judge a solution.
    Matrix<double, size> information = Matrix<double, size>::Zero();
    Regressors projection = Regressors::Zero();
    double energy = 0.0;
    double mean = 0.0;
    double count = 0.0;

    void add(const Sums& other, double sign);
    double variance() const { return energy - mean * mean / count; }
    double residual_energy(const Regressors& solution) const {
      return energy - 2.0 * solution.dot(projection) + solution.dot(information * solution);
    }
  };

  /// The sums of the whole experiment, to judge a fit to another one.
  Sums experiment() const { return sum(0, blocks_); }
  /// Fraction of the filtered power's variance in that experiment with this muscle that theta, with
  /// the best constant power, does not explain. NaN without samples.
  double unexplained_ratio(const Sums& experiment, const Theta& theta) const;

 private:
  Sums sum(std::size_t from, std::size_t to) const;
  Regressors regressors(const Vector<double, 5>& position) const;
  static Regressors solve(const Sums& sums);

  double position_scale_;
  Theta nominal_;
  Regressors weights_;
  StateVariableFilter<double, 5, Hold::zero_order> power_;
  StateVariableFilter<double, 5, Hold::first_order> position_;
  double believed_gain_;
  StateVariableFilter<double, 3, Hold::zero_order> believed_;
  StateVariableFilter<double, 5, Hold::first_order> instrument_;
  std::size_t blocks_ = 0;
  std::array<Sums, max_blocks> sums_;
};

}  // namespace supercoil::control
