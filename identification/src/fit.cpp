#include "supercoil/identification/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>

#include <Eigen/Dense>

#include "supercoil/identification/deviations.hpp"

namespace supercoil::identification {

namespace {

/// Variance per sample before anything is fitted, in squared percent of the stroke.
constexpr double first_variance = 50.0;

/// In percent of the stroke; last come the parameters' numbers over their prior deviations.
class Residuals {
 public:
  using Scalar = double;

  Residuals(const std::vector<Parameter>& parameters, const Samples& samples, Span span,
            const Sizes& sizes)
      : parameters_(parameters), samples_(samples), sizes_(sizes) {
    for (std::size_t k = 0; k < samples.size(); ++k)
      if (span.holds(samples.time_s(k)) && samples.measured(k)) rows_.push_back(k);
    simulated_ = rows_.empty() ? 0 : rows_.back() + 1;
  }

  Eigen::Index inputs() const { return static_cast<Eigen::Index>(parameters_.size()); }
  Eigen::Index data() const { return static_cast<Eigen::Index>(rows_.size()); }
  Eigen::Index values() const { return data() + inputs(); }

  /// Variance per sample, which weighs the data against the priors.
  void set_variance(double variance) { variance_ = variance; }

  int operator()(const Eigen::VectorXd& numbers, Eigen::VectorXd& residual) const {
    const std::vector<double> predicted =
        motion(muscle_from(parameters_, numbers), samples_, sizes_.full_W, simulated_);
    for (Eigen::Index i = 0; i < data(); ++i) {
      const std::size_t k = rows_[static_cast<std::size_t>(i)];
      residual[i] = (predicted[k] - samples_.position_m[k]) / (0.01 * sizes_.stroke_m);
    }
    for (Eigen::Index i = 0; i < inputs(); ++i) {
      residual[data() + i] =
          numbers[i] / parameters_[static_cast<std::size_t>(i)].deviation * std::sqrt(variance_);
    }
    // A step too far counts as a bad one and does not end the search.
    if (!residual.allFinite()) residual.setConstant(1e6);
    return 0;
  }

  int df(const Eigen::VectorXd& numbers, Eigen::MatrixXd& jacobian) const {
    constexpr double step = 1e-5;
    Eigen::VectorXd above(values());
    Eigen::VectorXd below(values());
    for (Eigen::Index i = 0; i < inputs(); ++i) {
      Eigen::VectorXd moved = numbers;
      moved[i] = numbers[i] + step;
      if ((*this)(moved, above) != 0) return -1;
      moved[i] = numbers[i] - step;
      if ((*this)(moved, below) != 0) return -1;
      jacobian.col(i) = (above - below) / (2.0 * step);
    }
    return 0;
  }

 private:
  const std::vector<Parameter>& parameters_;
  const Samples& samples_;
  const Sizes& sizes_;
  std::vector<std::size_t> rows_;
  std::size_t simulated_ = 0;
  double variance_ = first_variance;
};

void minimise(Residuals& residuals, Eigen::VectorXd& numbers) {
  Eigen::LevenbergMarquardt<Residuals> search(residuals);
  search.parameters.maxfev = 200;
  search.parameters.xtol = 1e-5;
  search.parameters.ftol = 1e-6;
  search.minimize(numbers);
}

void find_accuracy(Residuals& residuals, Fit& fit, const Sizes& sizes) {
  Eigen::VectorXd residual(residuals.values());
  Eigen::MatrixXd jacobian(residuals.values(), residuals.inputs());
  residuals(fit.numbers, residual);
  residuals.df(fit.numbers, jacobian);
  Eigen::VectorXd prior(residuals.inputs());
  for (Eigen::Index i = 0; i < prior.size(); ++i)
    prior[i] = fit.parameters[static_cast<std::size_t>(i)].deviation;
  const Accuracy accuracy = accuracy_of(jacobian.topRows(residuals.data()),
                                        residual.head(residuals.data()), fit.numbers, prior);
  fit.covariance = accuracy.covariance;
  fit.cross_validated_m = accuracy.cross_validated * 0.01 * sizes.stroke_m;
}

Muscle neutral_start(const Sizes& sizes, double time_constant_s) {
  Muscle start;
  start.gain_m_per_W = 2.0 * sizes.stroke_m / sizes.full_W;
  start.time_constant_s = time_constant_s;
  start.rest_m = sizes.first_m;
  return start;
}

}  // namespace

double Fit::deviation(std::size_t i) const {
  const auto at = static_cast<Eigen::Index>(i);
  return slope(parameters[i], numbers[at]) * std::sqrt(covariance(at, at));
}

Sizes sizes_of(const Samples& samples) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  Sizes sizes{};
  sizes.duration_s = static_cast<double>(samples.size()) * samples.step_s;
  sizes.step_s = samples.step_s;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    sizes.full_W = std::max(sizes.full_W, samples.power_W[k]);
    sizes.energy_J += samples.power_W[k] * samples.step_s;
    if (!samples.measured(k)) continue;
    if (lowest > highest) sizes.first_m = samples.position_m[k];
    lowest = std::min(lowest, samples.position_m[k]);
    highest = std::max(highest, samples.position_m[k]);
  }
  sizes.stroke_m = highest - lowest;
  return sizes;
}

Fit refit(const Muscle& start, const Effects& effects, const Samples& samples, Span span) {
  const Sizes sizes = sizes_of(samples);
  Fit result;
  result.effects = effects;
  result.parameters = parameters_of(effects, sizes);
  result.numbers = numbers_from(result.parameters, start);
  Residuals residuals(result.parameters, samples, span, sizes);
  minimise(residuals, result.numbers);
  // Once more, with the priors weighted by how well the model fits.
  Eigen::VectorXd residual(residuals.values());
  residuals(result.numbers, residual);
  residuals.set_variance(counted_variance(residual.head(residuals.data()), residuals.inputs()));
  minimise(residuals, result.numbers);
  residuals(result.numbers, residual);
  result.rms_m = residual.head(residuals.data()).norm() /
                 std::sqrt(static_cast<double>(residuals.data())) * 0.01 * sizes.stroke_m;
  result.muscle = muscle_from(result.parameters, result.numbers);
  result.predicted_m = motion(result.muscle, samples, sizes.full_W, samples.size());
  find_accuracy(residuals, result, sizes);
  return result;
}

Fit fit_model(const Effects& effects, const Samples& samples, Span span) {
  const Sizes sizes = sizes_of(samples);
  Fit best;
  best.rms_m = std::numeric_limits<double>::infinity();
  for (const double time_constant_s : {1.0, 4.0, 16.0}) {
    Fit found = refit(neutral_start(sizes, time_constant_s), effects, samples, span);
    if (found.rms_m < best.rms_m) best = std::move(found);
  }
  return best;
}

double rms_error(const Samples& samples, const std::vector<double>& predicted_m, Span span) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (!span.holds(samples.time_s(k)) || !samples.measured(k)) continue;
    sum += std::pow(predicted_m[k] - samples.position_m[k], 2);
    count += 1.0;
  }
  return std::sqrt(sum / count);
}

}  // namespace supercoil::identification
