// The simulated muscle: exactly the paper's while no effect is on.
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

  /// One tick. load_N stretches the muscle.
  void step(double power_W, double load_N = 0.0) {
    if (auto* linear = std::get_if<LinearPlant>(&plant_)) {
      linear->step(power_W, load_N);
    } else {
      std::get_if<NonlinearPlant>(&plant_)->step(power_W, load_N);
    }
  }

  /// Replaces the settings; the muscle's state is kept. When a linear muscle gets an effect, only
  /// its peak temperature is known of its past.
  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects);

  bool linear() const { return std::holds_alternative<LinearPlant>(plant_); }
  const control::PhysicalParameters& parameters() const;
  /// Above the air at the start.
  double temperature_rise_K() const;
  double position_m() const;
  double velocity_m_per_s() const;
  /// The highest rise so far.
  double peak_temperature_rise_K() const;

 private:
  double step_s_;
  std::variant<LinearPlant, NonlinearPlant> plant_;
};

}  // namespace supercoil::host_sim
