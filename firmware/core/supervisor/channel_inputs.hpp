// What a channel's supervisor judges by: the axis, the heater and the commands each fill their own.
#pragma once

#include <optional>

#include "board/measurement.hpp"
#include "supervisor/detectors/heater.hpp"
#include "supervisor/detectors/margin.hpp"

namespace supercoil {

/// Of the muscle's motion, at this tick.
struct AxisInputs {
  board::Measured position;         ///< in m, calibrated
  double sensor_m = 0.0;            ///< the same as the sensor gives it
  double position_elapsed_s = 0.0;  ///< since the last fresh position; 0: this one is not fresh
  double demanded_W = 0.0;          ///< by the controller, at the last tick
  bool in_joint = false;
  /// By how much the other muscle of the joint moves it away, as HeaterInputs::expected_m.
  detectors::NotResponding::Expected opposed_m{};
  double from_position_K = 0.0;  ///< temperature that the position tells, beside the resistance's
  bool answered = false;         ///< the muscle was seen to follow its power
  bool unanswered = false;       ///< the muscle was asked to prove that it answers, and did not,
  detectors::Margin answer;      ///< and by how much
  std::optional<detectors::Recalibration> recalibrated;  ///< positions jumped
  bool expected_anew = false;                            ///< what is expected of them jumped
};

/// Of the heater, at this tick.
struct HeaterInputs {
  board::Measured current;  ///< in A, averaged
  double supply_V = 0.0;
  bool hot = false;   ///< the muscle may be warmer than the air
  bool off = true;    ///< no duty is set, or the enable line is low
  double duty = 0.0;  ///< as the current sense averages it
  int set_step = 0;
  int read_back = -1;
  bool devices_ok = true;                           ///< every write of the last tick was taken
  detectors::NotResponding::Expected expected_m{};  ///< where the models of the muscle are
  double hottest_C = 0.0;
  double applied_W = 0.0;          ///< as it was set
  double measured_W = 0.0;         ///< the larger of that and the measured one
  bool limited = false;            ///< what was set is less than what was wanted
  double from_resistance_K = 0.0;  ///< the temperature that it tells; 0: none
  bool probed = false;             ///< a probe ended at this tick with the next value
  bool resistance_fresh = false;   ///< it was measured at this tick, by a probe or while heating
  double resistance_Ohm = 0.0;
  double min_Ohm = 0.0;  ///< between these it should be, at whichever temperature
  double max_Ohm = 0.0;
  bool probe_failed = false;  ///< a probe ended without a resistance
};

/// Of the commands since the last tick.
struct CommandInputs {
  bool heating = false;  ///< a command to heat is in force
  bool renewed = false;
  bool damaged = false;
  bool refused = false;
  bool obeyed = false;
};

}  // namespace supercoil
