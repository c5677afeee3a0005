// A simulation run as its author wrote it, checked and complete.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "scenario/reference.hpp"
#include "simulated_board/position_sensor.hpp"
#include "simulated_board/power_output.hpp"

namespace supercoil::host_sim {

/// The simulated muscle and what hangs on it.
struct PlantSettings {
  control::PhysicalParameters parameters;
  double resistance_Ohm = 10.0;  ///< of the heater
  double load_N = 0.0;           ///< pulls the muscle longer, on top of the moving mass

  friend bool operator==(const PlantSettings&, const PlantSettings&) = default;
};

/// Everything that an event can change.
struct Conditions {
  PlantSettings plant;
  control::PhysicalParameters muscle;  ///< what the board believes the muscle to be
  PositionSensorSettings position_sensor;
  PowerSettings power;
  Reference reference;
  control::ControllerSettings controller;
  control::EstimatorSettings estimator;
};

/// From at_s on, the scenario runs under other conditions.
struct Event {
  double at_s;
  Conditions conditions;
  bool new_controller;  ///< the event names [controller]: it starts anew with the new settings
  bool new_estimator;   ///< likewise [estimator]
};

struct Scenario {
  std::string name;
  double duration_s = 200.0;
  double rate_Hz = 1000.0;
  std::uint64_t seed = 1;
  int substeps = 1;
  Conditions start;
  std::vector<Event> events;  ///< in the order of their times

  double step_s() const { return 1.0 / rate_Hz; }
  /// Number of ticks, the one at time 0 included, the one at duration_s not.
  long ticks() const { return std::lround(duration_s * rate_Hz); }
};

}  // namespace supercoil::host_sim
