#include <cmath>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/controller.hpp"

namespace supercoil::control {

void ControllerSettings::set_nominal(const PhysicalParameters& muscle, double max_W) {
  dc_gain_m_per_W = muscle.dc_gain_m_per_W();
  const RegressionScale scale{theta_from(muscle), dc_gain_m_per_W, muscle.moving_mass_kg};
  shaped_for = adaptive_ff.scale = learned_ff.scale = mrac_ls.scale = scale;
  pd_ff.feedforward_W_per_m = 1.0 / dc_gain_m_per_W;
  if (std::isfinite(max_W)) learned_ff.max_W = max_W;
}

}  // namespace supercoil::control
