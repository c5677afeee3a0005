// One scenario, tick by tick.
#pragma once

#include <cstddef>

#include "plant/linear_plant.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// What there is to see of one tick. Powers act from this tick to the next.
struct TickRecord {
  double time_s = 0.0;
  double reference = 0.0;  ///< metres, or watts in open loop
  double model_m = 0.0;    ///< where the reference model is
  double position_m = 0.0;
  double measured_m = 0.0;
  double power_W = 0.0;          ///< as the controller wanted it
  double applied_power_W = 0.0;  ///< after limits, PWM and delay
  double temperature_rise_K = 0.0;
  bool limited = false;
  bool open_loop = false;  ///< there is no reference model, and the reference is a power
};

/// Runs the controller and the estimator of a scenario against the simulated muscle. The same
/// scenario gives the same records, to the bit.
class Simulation {
 public:
  explicit Simulation(const Scenario& scenario);

  bool done() const { return tick_ >= ticks_; }
  /// One tick: events, measure, estimate, control, apply, and the muscle moves on.
  TickRecord step();

  long tick() const { return tick_; }
  long ticks() const { return ticks_; }
  const Conditions& conditions() const { return *conditions_; }
  /// Empty when the scenario has no estimator.
  std::optional<control::Estimate> estimate() const { return estimator_.estimate(); }
  const LinearPlant& plant() const { return plant_; }

 private:
  void happen(const Event& event);

  const Scenario* scenario_;
  const Conditions* conditions_;
  long ticks_;
  double step_s_;
  long tick_ = 0;
  std::size_t next_event_ = 0;
  LinearPlant plant_;
  PositionSensor sensor_;
  PowerOutput output_;
  control::Controller controller_;
  control::Estimator estimator_;
};

}  // namespace supercoil::host_sim
