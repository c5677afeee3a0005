#include "estimators/contender.hpp"

#include "supercoil/control/estimation/gradient.hpp"
#include "supercoil/control/estimation/least_squares.hpp"

#include "estimators/muscle_filter.hpp"

namespace supercoil::host_sim::estimators {

using control::Theta;

Theta Contender::standard_deviations() const {
  return Theta::Constant(NAN);
}

namespace {

class Gradient : public Contender {
 public:
  Gradient(const control::GradientSettings& settings, double step_s)
      : to_watts_(1.0 / settings.scale.dc_gain_m_per_W), estimator_(settings, step_s) {}
  void step(double position_m, double power_W) override {
    estimator_.step(position_m * to_watts_, power_W);
  }
  Theta theta() const override { return estimator_.theta(); }

 private:
  double to_watts_;
  control::GradientEstimator<double> estimator_;
};

class LeastSquares : public Contender {
 public:
  LeastSquares(const control::LeastSquaresSettings& settings, double step_s)
      : scale_(settings.scale), estimator_(settings, step_s) {}
  void step(double position_m, double power_W) override {
    estimator_.step(position_m / scale_.dc_gain_m_per_W, power_W);
  }
  Theta theta() const override {
    return estimator_.parameters().head<4>().cwiseProduct(scale_.nominal);
  }
  /// Relative to nominal, which is near θ.
  Theta standard_deviations() const override {
    return estimator_.standard_deviations()
        .head<4>()
        .cwiseProduct(scale_.nominal)
        .cwiseQuotient(theta());
  }

 private:
  control::RegressionScale scale_;
  control::LeastSquaresEstimator<double> estimator_;
};

class Kalman : public Contender {
 public:
  Kalman(Predict predict, const FilterSettings& settings, double step_s)
      : filter_(predict, settings, step_s) {}
  void step(double position_m, double power_W) override { filter_.step(position_m, power_W); }
  Theta theta() const override { return filter_.theta(); }
  Theta standard_deviations() const override { return filter_.standard_deviations(); }

 private:
  MuscleFilter filter_;
};

std::unique_ptr<Contender> make_gradient(const Theta& initial, double step_s) {
  control::GradientSettings settings;
  settings.initial = initial;
  return std::make_unique<Gradient>(settings, step_s);
}

std::unique_ptr<Contender> make_normalised(const Theta& initial, double step_s) {
  control::GradientSettings settings;
  settings.initial = initial;
  // Near the best of 1500 random ones, on the nominal trial.
  settings.gain = settings.gain.cwiseProduct(Theta{4.5, 0.9, 2.5, 0.2});
  settings.normalisation = 1e-3;
  // The same bounds as the others.
  const control::LeastSquaresSettings bounds;
  const Theta& nominal = settings.scale.nominal;
  settings.bounds = control::Box<double, 4>{nominal * bounds.min_ratio, nominal * bounds.max_ratio};
  return std::make_unique<Gradient>(settings, step_s);
}

std::unique_ptr<Contender> make_least_squares(const Theta& initial, double step_s) {
  control::LeastSquaresSettings settings;
  settings.initial = initial;
  settings.forgetting_s = forgetting_s;
  return std::make_unique<LeastSquares>(settings, step_s);
}

std::unique_ptr<Contender> make_extended(const Theta& initial, double step_s) {
  FilterSettings settings;
  settings.initial = initial;
  settings.forgetting_s = forgetting_s;
  return std::make_unique<Kalman>(predict_extended, settings, step_s);
}

std::unique_ptr<Contender> make_unscented(const Theta& initial, double step_s) {
  FilterSettings settings;
  settings.initial = initial;
  settings.forgetting_s = forgetting_s;
  // With the extended filter's ratio it became sure of θ1 while θ1 was 3 % off.
  settings.remainder_ratio = 0.2;
  settings.changed_logarithm = 0.2;
  settings.changed_bias_W = 0.2;
  settings.changed_acceleration_m_per_s2 = 0.5;
  return std::make_unique<Kalman>(predict_unscented, settings, step_s);
}

}  // namespace

const std::array<ContenderKind, 5> contenders{{
    {"gradient", "the paper's law and gains", make_gradient},
    {"normalised", "gradient, other gains, normalised, projected", make_normalised},
    {"least_squares", "recursive, with forgetting", make_least_squares},
    {"ekf", "extended Kalman filter", make_extended},
    {"ukf", "unscented Kalman filter", make_unscented},
}};

}  // namespace supercoil::host_sim::estimators
