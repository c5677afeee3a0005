#include "plant/heat_transfer.hpp"

namespace supercoil::host_sim {

void HeatTransfer::set(const control::PhysicalParameters& parameters, const PlantEffects& effects,
                       double step_s) {
  constexpr double zero_C_in_K = 273.15;
  const double whole = parameters.heat_transfer_W_per_K * effects.draught_ratio;
  const double start_K = zero_C_in_K + effects.air_C;
  const double slope_W_per_K = last_W_per_K_ - before_W_per_K_;
  const double old_W_per_K = last_W_per_K_;
  step_s_ = step_s;
  half_step_K_per_W_ = 0.5 * step_s / parameters.thermal_mass_J_per_K;
  constant_W_per_K_ = whole * (1.0 - effects.convection_ratio - effects.radiation_ratio);
  convection_W_per_K_ =
      whole * effects.convection_ratio / std::sqrt(std::sqrt(effects.heat_transfer_at_K));
  radiation_ =
      whole * effects.radiation_ratio / radiation(start_K + effects.heat_transfer_at_K, start_K);
  air_K_ = effects.air_change_K;
  absolute_air_K_ = start_K + air_K_;
  last_W_per_K_ = conductance_W_per_K(before_rise_K_);
  before_W_per_K_ = last_W_per_K_;
  // If the settings did not change the heat transfer, its slope is kept.
  if (last_W_per_K_ == old_W_per_K) before_W_per_K_ -= slope_W_per_K;
}

void HeatTransfer::start_from(double rise_K) {
  rise_K_ = before_rise_K_ = rise_K;
  last_W_per_K_ = before_W_per_K_ = conductance_W_per_K(rise_K);
}

}  // namespace supercoil::host_sim
