#include "supercoil/control/tracking/mrac_premises.hpp"

#include <cmath>

namespace supercoil::control {

MracPremises check_premises(const MracSettings& settings, const ReferenceModelSettings& model) {
  const double p0 = settings.p0_rad_per_s;
  const double p1 = settings.p1_rad_per_s;
  const double q0 = settings.q0_rad_per_s;
  MracPremises premises{};
  premises.lambda_hurwitz = is_hurwitz<2>(settings.lambda);
  premises.poles_positive = p0 > 0.0 && p1 > 0.0 && q0 > 0.0;
  premises.gains_positive =
      (settings.gain.array() > 0.0).all() && settings.sigma_gain >= 0.0 && settings.damping >= 0.0;
  premises.model_hurwitz = is_hurwitz<3>(model.denominator) && model.gain > 0.0;
  const Polynomial<2> numerator{model.gain * p0 * p1, model.gain * (p0 + p1), model.gain};
  premises.realness = positive_realness(numerator, model.denominator);
  const ReferenceModelSettings matched = poles_model({p0, p1, q0});
  premises.model_factors = true;
  for (std::size_t i = 0; i < matched.denominator.size(); ++i) {
    const double difference = matched.denominator[i] - model.denominator[i];
    if (!(std::abs(difference) <= 1e-6 * matched.denominator[i])) premises.model_factors = false;
  }
  return premises;
}

std::array<const char*, MracPremises::count> MracPremises::failures() const {
  return {
      lambda_hurwitz ? nullptr : "lambda(s) is not Hurwitz",
      poles_positive ? nullptr : "p0, p1 and q0 must be positive",
      gains_positive ? nullptr : "every gain of Pi must be positive, nu and alpha0 not negative",
      model_hurwitz ? nullptr : "the reference model is not stable",
      realness.strict() ? nullptr : "Wm(s)(s+p0)(s+p1) is not strictly positive real",
      model_factors ? nullptr : "Eq. (12) needs Wm = k/((s+p0)(s+p1)(s+q0))",
  };
}

}  // namespace supercoil::control
