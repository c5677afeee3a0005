#include "apps/supercoil/setup/recommended_controller.hpp"

#include <algorithm>
#include <cmath>

#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

using control::ControllerKind;
using control::ControllerSettings;

constexpr ControllerKind recommended_kind = ControllerKind::learned_ff;
constexpr double max_bandwidth_rad_per_s = 8.0;
/// Of the paper's muscle, for which the controllers' defaults are.
constexpr double usual_time_constant_s = 1.82;
constexpr double telling_bandwidth_ratio = 0.1;
constexpr int bandwidth_digits = 4;

}  // namespace

std::string RecommendedController::literal() const {
  return "{ kind = \"" +
         std::string(control::name_of(control::controller_names, recommended_kind)) +
         "\", shape_reference = true, bandwidth_rad_per_s = " +
         number_text(bandwidth_rad_per_s, bandwidth_digits) + " }";
}

ControllerSettings RecommendedController::in_place_of(ControllerSettings controller) const {
  controller.kind = recommended_kind;
  controller.shape_reference = true;
  controller.learned_ff.bandwidth_rad_per_s = bandwidth_rad_per_s;
  return controller;
}

bool RecommendedController::differs_from(const ControllerSettings& controller) const {
  const double ratio = controller.learned_ff.bandwidth_rad_per_s / bandwidth_rad_per_s;
  return controller.kind != recommended_kind || !controller.shape_reference ||
         std::abs(ratio - 1.0) > telling_bandwidth_ratio;
}

RecommendedController recommended_controller(const control::PhysicalParameters& muscle) {
  // A slow muscle's feedback need not be fast: with the default its noise and its friction show.
  const double tau_s = -1.0 / muscle.thermal_pole_rad_per_s();
  const double slowness = std::max(1.0, tau_s / usual_time_constant_s);
  const std::string usual = number_text(usual_time_constant_s, 3) + " s";
  const std::string own = number_text(tau_s, 3) + " s";
  const std::string why =
      slowness > 1.0
          ? " over the root of its time constant, " + own + ", in units of the paper's " + usual
          : ", as its time constant, " + own + ", does not exceed the paper's " + usual;
  return {max_bandwidth_rad_per_s / std::sqrt(slowness),
          "follows closest, and asks for no motion that the muscle cannot make; " +
              number_text(max_bandwidth_rad_per_s, 3) + " rad/s" + why};
}

}  // namespace supercoil::operating
