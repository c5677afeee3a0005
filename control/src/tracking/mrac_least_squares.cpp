#include "supercoil/control/tracking/mrac_least_squares.hpp"

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::control {

MracSettings filters_of(const MracLeastSquaresSettings& settings) {
  MracSettings filters;
  filters.lambda = squared_pole(settings.filter_rad_per_s);
  filters.alpha = {filters.lambda[1], filters.lambda[0]};
  return filters;
}

std::optional<MracMatching> match(const MracLeastSquaresSettings& settings,
                                  const ReferenceModelSettings& model) {
  const Theta& theta = settings.scale.nominal;
  const double cubic = theta[0] * settings.scale.moving_mass_kg;
  const double b0 = theta[3] / cubic;
  return match({b0, theta[2] / cubic, theta[1] / cubic, b0}, filters_of(settings), model);
}

void MracLeastSquaresLaw::set_nominal(Settings& s, const RegressionScale& scale, double) {
  s.scale = scale;
}

std::optional<FixedLaw> MracLeastSquaresLaw::fixed_law(const Settings& s, const LawContext& context,
                                                       const PhysicalParameters& muscle) {
  const FixedLaw pid =
      fixed_pid_law(theta_from(muscle), s.bandwidth_rad_per_s, s.derivative_filter_rad_per_s);
  return add_matched(pid, filters_of(s), context, muscle);
}

}  // namespace supercoil::control
