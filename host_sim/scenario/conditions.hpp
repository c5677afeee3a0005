// Everything in a scenario that an event can change.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "loop/settings.hpp"
#include "plant/effects.hpp"
#include "plant/joint_plant.hpp"
#include "scenario/injected_faults.hpp"
#include "scenario/reference.hpp"

namespace supercoil::host_sim {

/// The simulated muscle and what hangs on it.
struct PlantSettings {
  control::PhysicalParameters parameters;
  PlantEffects effects;
  bool air_acts = false;         ///< the muscle follows a change of the air's temperature
  double resistance_Ohm = 10.0;  ///< of the cold heater
  double temperature_coefficient_per_K = 0.0;  ///< of that resistance
  double load_N = 0.0;  ///< stretches the muscle, in addition to the moving mass

  friend bool operator==(const PlantSettings&, const PlantSettings&) = default;
};

/// The muscle that pulls against the scenario's own.
struct AntagonistConditions {
  PlantSettings plant;
  control::PhysicalParameters muscle;  ///< what the board believes it to be
  double co_contraction_W = 1.0;
  int pwm_steps = 0;  ///< 0: as in [power]
};

/// A joint that the muscle turns against another one, a spring or a weight.
struct JointConditions {
  JointPlantSettings plant;                        ///< without its muscles
  double load_Nm = 0.0;                            ///< turns it towards negative angles
  std::optional<AntagonistConditions> antagonist;  ///< empty: spring or weight oppose alone
};

/// Place in a joint without an antagonist, as on a board that knows of the joint.
inline PlaceInJoint single_muscle_place(const JointPlantSettings& joint) {
  PlaceInJoint place{.direction = 1, .lever = joint.lever};
  if (joint.spring_pretensions) return place;
  place.weight_Nm = joint.weight_Nm;
  place.hangs_at_rad = joint.hangs_at_rad;
  return place;
}

struct PositionSensorSettings {
  double noise_rms_m = 10e-6;
  int resolution_bits = 16;  ///< 0: practically not quantised
  double count_m = 0.0;      ///< of a reading; 0: by resolution_bits
  double rate_Hz = 0.0;      ///< of conversions; 0: one at each reading
  double min_m = 0.0;        ///< lowest reading
  double range_m = 0.040;    ///< highest reading

  friend bool operator==(const PositionSensorSettings&, const PositionSensorSettings&) = default;
};

/// A second sensor, which the firmware does not read.
struct ThermometerSettings {
  bool present = false;
  double lag_s = 2.0;  ///< time constant
  double offset_K = 0.0;
  double noise_rms_K = 0.0;
  double rate_Hz = 10.0;

  friend bool operator==(const ThermometerSettings&, const ThermometerSettings&) = default;
};

struct PowerSettings {
  double max_W = 4.5;
  double min_W = 0.0;
  int pwm_steps = 0;  ///< of a period; 0: ideal
  double supply_V = 12.0;
  bool error_feedback = true;  ///< what rounding took from one duty is added to the next
  double delay_s = 0.0;        ///< actuation delay, rounded to whole ticks
  double gain = 1.0;           ///< heat in the muscle over electrical power, unmeasured

  friend bool operator==(const PowerSettings&, const PowerSettings&) = default;
};

/// What the firmware knows of the muscle's heat: each quantity lies within these ratios of what the
/// board believes.
struct ThermalSpans {
  std::array<double, 2> mass_ratio{0.75, 1.35};
  std::array<double, 2> transfer_ratio{0.45, 2.2};
  std::array<double, 2> power_ratio{1.0, 1.0};  ///< in addition to the error of the senses

  friend bool operator==(const ThermalSpans&, const ThermalSpans&) = default;
};

/// The air around the muscle, and what the board believes of it.
struct Ambient {
  double air_C = 25.0;
  double warmest_C = 25.0;
  double coldest_C = 25.0;
  double sensor_error_K = 0.0;   ///< that the board assumes for its sensor; 0: it has none
  double sensor_offset_K = 0.0;  ///< actual error of the sensor

  friend bool operator==(const Ambient&, const Ambient&) = default;
};

/// The operator's action, applied at every tick.
enum class OperatorAction { track, rest, disarm, identify, calibrate, first_motion, none };
inline constexpr control::Names<OperatorAction, 7> operator_action_names{
    {{"track", OperatorAction::track},
     {"rest", OperatorAction::rest},
     {"disarm", OperatorAction::disarm},
     {"identify", OperatorAction::identify},
     {"calibrate", OperatorAction::calibrate},
     {"first_motion", OperatorAction::first_motion},
     {"none", OperatorAction::none}}};

/// Whether the operator arms the muscle at the start for this action.
constexpr bool arms(OperatorAction action) {
  return action != OperatorAction::none && action != OperatorAction::disarm;
}

struct Conditions {
  /// The travel limit over the sensor's range.
  static constexpr double travel_ratio = 0.999;

  PlantSettings plant;                 ///< of a joint: its agonist
  control::PhysicalParameters muscle;  ///< what the board believes the muscle to be
  std::optional<JointConditions> joint;
  /// The other muscles of a bundle, each with its own heater; empty: no bundle.
  std::vector<PlantSettings> companions;
  PositionSensorSettings position_sensor;
  ThermometerSettings thermometer;
  PowerSettings power;
  ThermalSpans thermal;
  Ambient ambient;
  double sense_error_ratio = 0.02;  ///< left after a comparison with a meter; 0: never compared
  InjectedFaults injected_faults;
  OperatorAction action = OperatorAction::track;
  Reference reference;
  control::ControllerSettings controller;
  control::EstimatorSettings estimator;

  /// Null if the muscle is alone, or opposed by a spring or a weight.
  const AntagonistConditions* antagonist() const {
    return joint && joint->antagonist ? &*joint->antagonist : nullptr;
  }
};

}  // namespace supercoil::host_sim
