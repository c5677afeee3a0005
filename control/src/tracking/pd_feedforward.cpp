#include "supercoil/control/tracking/pd_feedforward.hpp"

namespace supercoil::control {

void PdFeedforwardLaw::set_nominal(Settings& s, const RegressionScale& scale, double) {
  s.feedforward_W_per_m = 1.0 / scale.dc_gain_m_per_W;
}

void PdFeedforwardLaw::check_fit(FixedPointFit& fit, const Settings& s, const LawContext& context,
                                 double, double) {
  const double unit = context.dc_gain_m_per_W;
  fit.at_most("proportional_W_per_m", s.proportional_W_per_m * unit, FixedPointFit::signal);
  fit.at_most("derivative_Ws_per_m", s.derivative_Ws_per_m * unit, FixedPointFit::signal);
  fit.at_most("feedforward_W_per_m", s.feedforward_W_per_m * unit, FixedPointFit::signal);
  fit.at_most("derivative_filter_rad_per_s",
              s.derivative_filter_rad_per_s * s.derivative_filter_rad_per_s, FixedPointFit::state);
}

}  // namespace supercoil::control
