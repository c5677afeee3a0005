#include "supercoil/control/tracking/fixed_law.hpp"

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/mrac_matching.hpp"

namespace supercoil::control {

namespace {

FixedLaw pid_of(const Theta& theta, double bandwidth_rad_per_s, double filter_rad_per_s) {
  const Theta gains = theta * bandwidth_rad_per_s;
  return {gains[2], gains[3], gains[1], filter_rad_per_s};
}

/// Adds the feedback by θ*. The laws have positions in watts at rest.
std::optional<FixedLaw> matched(FixedLaw law, const MracSettings& filters,
                                const ControllerSettings& settings,
                                const PhysicalParameters& muscle) {
  TransferFunction plant = transfer_function_from(muscle);
  plant.b3 /= settings.dc_gain_m_per_W;
  const auto matching = match(plant, filters, settings.model);
  if (!matching) return std::nullopt;
  const MracSettings::Parameters& theta = matching->theta;
  const std::array<double, 2>& alpha = filters.alpha;
  const double per_m = 1.0 / settings.dc_gain_m_per_W;
  law.filtered = {filters.lambda,
                  {theta[1] * alpha[1], theta[0] * alpha[0]},
                  {theta[3] * alpha[1] * per_m, theta[2] * alpha[0] * per_m},
                  theta[4] * per_m};
  return law;
}

}  // namespace

std::optional<FixedLaw> fixed_law(const ControllerSettings& s, const PhysicalParameters& muscle) {
  switch (s.kind) {
    case ControllerKind::pi:
      return FixedLaw{s.pi.proportional_W_per_m, s.pi.integral_W_per_m_s};
    case ControllerKind::pd_ff:
      return FixedLaw{s.pd_ff.proportional_W_per_m, 0.0, s.pd_ff.derivative_Ws_per_m,
                      s.pd_ff.derivative_filter_rad_per_s};
    case ControllerKind::adaptive_ff:
      return pid_of(theta_from(muscle), s.adaptive_ff.bandwidth_rad_per_s,
                    s.adaptive_ff.derivative_filter_rad_per_s);
    case ControllerKind::learned_ff: {
      const Theta theta = theta_from(muscle);
      return pid_of(
          theta, feedback_bandwidth(s.learned_ff.bandwidth_rad_per_s, theta, muscle.moving_mass_kg),
          s.learned_ff.derivative_filter_rad_per_s);
    }
    case ControllerKind::mrac:
      return matched({}, s.mrac, s, muscle);
    case ControllerKind::mrac_ls:
      return matched(pid_of(theta_from(muscle), s.mrac_ls.bandwidth_rad_per_s,
                            s.mrac_ls.derivative_filter_rad_per_s),
                     filters_of(s.mrac_ls), s, muscle);
    case ControllerKind::power:
      break;
  }
  return std::nullopt;
}

}  // namespace supercoil::control
