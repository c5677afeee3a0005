// The simulated muscle: exactly the paper's as long as no effect is on.
#pragma once

#include <variant>

#include "plant/linear_plant.hpp"
#include "plant/nonlinear_plant.hpp"

namespace supercoil::host_sim {

/// Power and load in; temperature, position and velocity out.
class Plant {
 public:
  /// Valid parameters and effects; step_s > 0, the tick.
  Plant(const control::PhysicalParameters& parameters, const PlantEffects& effects, double step_s);

  /// One tick. load_N pulls the muscle longer.
  void step(double power_W, double load_N = 0.0) {
    if (auto* linear = std::get_if<LinearPlant>(&plant_)) {
      linear->step(power_W, load_N);
    } else {
      std::get_if<NonlinearPlant>(&plant_)->step(power_W, load_N);
    }
  }

  /// From now on; the muscle's state stays. A linear muscle that gets an effect has no past but its
  /// peak temperature.
  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects);

  bool linear() const { return std::holds_alternative<LinearPlant>(plant_); }
  const control::PhysicalParameters& parameters() const;
  /// Above the air as it was at the start.
  double temperature_rise_K() const;
  double position_m() const;
  double velocity_m_per_s() const;
  /// The hottest that the muscle was.
  double peak_temperature_rise_K() const;

 private:
  double step_s_;
  std::variant<LinearPlant, NonlinearPlant> plant_;
};

}  // namespace supercoil::host_sim
