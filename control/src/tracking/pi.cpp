#include "supercoil/control/tracking/pi.hpp"

namespace supercoil::control {

void PiLaw::check_fit(FixedPointFit& fit, const Settings& s, const LawContext& context, double,
                      double) {
  const double unit = context.dc_gain_m_per_W;
  fit.at_most("proportional_W_per_m", s.proportional_W_per_m * unit, FixedPointFit::signal);
  fit.at_most("integral_W_per_m_s", s.integral_W_per_m_s * unit, FixedPointFit::signal);
}

}  // namespace supercoil::control
