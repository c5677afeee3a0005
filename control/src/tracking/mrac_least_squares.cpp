#include "supercoil/control/tracking/mrac_least_squares.hpp"

namespace supercoil::control {

std::optional<MracMatching> match(const MracLeastSquaresSettings& settings,
                                  const ReferenceModelSettings& model) {
  MracSettings equivalent;
  equivalent.lambda = squared_pole(settings.filter_rad_per_s);
  equivalent.alpha = {equivalent.lambda[1], equivalent.lambda[0]};
  const Theta& theta = settings.scale.nominal;
  const double cubic = theta[0] * settings.scale.moving_mass_kg;
  const double b0 = theta[3] / cubic;
  return match({b0, theta[2] / cubic, theta[1] / cubic, b0}, equivalent, model);
}

}  // namespace supercoil::control
