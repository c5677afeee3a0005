#include "supercoil/control/tracking/adaptive_feedforward.hpp"

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::control {

void AdaptiveFeedforwardLaw::set_nominal(Settings& s, const RegressionScale& scale, double) {
  s.scale = scale;
}

std::optional<FixedLaw> AdaptiveFeedforwardLaw::fixed_law(const Settings& s, const LawContext&,
                                                          const PhysicalParameters& muscle) {
  return fixed_pid_law(theta_from(muscle), s.bandwidth_rad_per_s, s.derivative_filter_rad_per_s);
}

void AdaptiveFeedforwardLaw::check_fit(FixedPointFit& fit, const Settings& s, const LawContext&,
                                       double step_s, double) {
  const Theta units = s.scale.nominal * s.scale.dc_gain_m_per_W;
  fit.at_most("bandwidth_rad_per_s", s.bandwidth_rad_per_s * std::max(units[1], units[2]),
              FixedPointFit::signal);
  fit.at_most("bandwidth_rad_per_s", s.bandwidth_rad_per_s * units[3] * step_s,
              FixedPointFit::state);
  fit.at_most("derivative_filter_rad_per_s",
              s.derivative_filter_rad_per_s * s.derivative_filter_rad_per_s, FixedPointFit::state);
}

}  // namespace supercoil::control
