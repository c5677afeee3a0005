#include "supercoil/control/tracking/reference_model.hpp"

namespace supercoil::control {

ReferenceModelSettings design_model() {
  return {{0.8, 2.104, 2.18, 1.0}, 0.8};
}

ReferenceModelSettings eq8_model() {
  return {{1.0, 1.38, 1.0, 1.0}, 1.0};
}

ReferenceModelSettings wm16_model() {
  return poles_model({4.0, 5.0, 0.8});
}

ReferenceModelSettings poles_model(const std::array<double, 3>& p) {
  const double product = p[0] * p[1] * p[2];
  return {{product, p[0] * p[1] + p[0] * p[2] + p[1] * p[2], p[0] + p[1] + p[2], 1.0}, product, p};
}

std::optional<ReferenceModelSettings> reference_model_named(std::string_view name) {
  if (name == "design") return design_model();
  if (name == "eq8") return eq8_model();
  if (name == "wm16") return wm16_model();
  return std::nullopt;
}

}  // namespace supercoil::control
