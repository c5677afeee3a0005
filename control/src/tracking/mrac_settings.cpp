#include "supercoil/control/tracking/mrac_settings.hpp"

namespace supercoil::control {

MracSettings MracSettings::scaled(double factor) const {
  MracSettings result = *this;
  result.gain *= factor;
  result.sigma_gain *= factor;
  result.adaptation_scale *= factor;
  return result;
}

std::optional<MracSettings> mrac_preset(std::string_view name) {
  if (name == "printed") return MracSettings{};
  if (name == "a") {
    MracSettings a = MracSettings{}.scaled(20.0);
    a.adaptation_scale = 1.0;
    a.alpha = {20.0, 400.0};
    a.lambda = {400.0, 40.0, 1.0};
    a.damping = 1.0;
    a.initial[5] = 0.3;
    return a;
  }
  return std::nullopt;
}

}  // namespace supercoil::control
