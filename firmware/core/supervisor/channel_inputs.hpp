// Inputs of a channel's supervisor. The axis, the heater and the commands each fill their own.
#pragma once

#include <optional>

#include "board/measurement.hpp"
#include "supervisor/detectors/heater.hpp"
#include "supervisor/detectors/margin.hpp"

namespace supercoil {

/// The muscle's motion at this tick.
struct AxisInputs {
  board::Measured position;         ///< in m, calibrated
  double sensor_m = 0.0;            ///< the same before calibration
  double position_elapsed_s = 0.0;  ///< since the last fresh position; 0: this one is not fresh
  double demanded_W = 0.0;          ///< by the controller, at the last tick
  bool in_joint = false;
  /// How far the joint's other muscle moves it the other way; as HeaterInputs::expected_m.
  detectors::NotResponding::Expected opposed_m{};
  double from_position_K = 0.0;  ///< by the position; compared with from_resistance_K
  bool answered = false;         ///< the muscle was seen to follow its power
  bool unanswered = false;       ///< the muscle had to prove that it answers, and did not
  detectors::Margin answer;      ///< of that proof
  std::optional<detectors::Recalibration> recalibrated;  ///< a calibration shifted the positions
  bool expected_jumped = false;                          ///< the expected positions jumped
};

/// The heater at this tick.
struct HeaterInputs {
  board::Measured current;  ///< in A, averaged
  double supply_V = 0.0;
  bool hot = false;   ///< the muscle may be warmer than the air
  bool off = true;    ///< no duty is set, or the enable line is low
  double duty = 0.0;  ///< as the current sense averages it
  int set_step = 0;
  int read_back = -1;
  bool devices_ok = true;                           ///< every write of the last tick succeeded
  detectors::NotResponding::Expected expected_m{};  ///< positions of the muscle's models
  double hottest_C = 0.0;
  double applied_W = 0.0;          ///< as it was set
  double measured_W = 0.0;         ///< the larger of applied and measured power
  bool limited = false;            ///< less was set than was demanded
  double from_resistance_K = 0.0;  ///< temperature rise by the resistance; 0: none
  bool probed = false;             ///< a probe ended at this tick; resistance_Ohm is its result
  bool resistance_fresh = false;   ///< measured at this tick, by a probe or while heating
  double resistance_Ohm = 0.0;
  double min_Ohm = 0.0;  ///< bounds of resistance_Ohm over all possible temperatures
  double max_Ohm = 0.0;
  bool probe_failed = false;  ///< a probe ended without a resistance
};

/// The commands since the last tick.
struct CommandInputs {
  bool heating = false;  ///< a command to heat is in force
  bool renewed = false;
  bool damaged = false;
  bool refused = false;
  bool obeyed = false;
};

}  // namespace supercoil
