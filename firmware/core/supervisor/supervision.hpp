// The thresholds of every detector.
#pragma once

namespace supercoil {

/// Measured power above this is a fault, unless configured otherwise.
constexpr double default_max_measured_W(double max_W) {
  return 1.25 * max_W + 0.3;
}

/// Below this resistance the heater is shorted, unless configured otherwise.
constexpr double default_least_resistance_Ohm(double cold_Ohm) {
  return 0.5 * cold_Ohm;
}

/// Likewise for energy. Holding max_W indefinitely is not a fault: the temperature interval judges
/// how hot that makes the muscle. More than this flows only if more is measured than was asked for.
constexpr double default_energy_J(double max_W, double window_s) {
  return 1.1 * max_W * window_s;
}

/// Defaults are for the paper's muscle. Times are the detection times that docs/faults states.
struct ChannelSupervision {
  // Sensors
  double min_position_m = -0.002;  ///< outside: the sensor's wire, not the muscle
  double max_position_m = 0.042;
  double out_of_range_s = 0.005;
  double position_noise_rms_m = 10e-6;  ///< 0: a frozen sensor looks like a quiet one
  double frozen_s = 1.0;
  double max_speed_m_per_s = 0.5;
  double disagree_K = 30.0;  ///< between the temperatures from resistance and from position
  double disagree_s = 2.0;
  // Heater
  double open_min_duty = 0.02;
  double open_s = 0.02;
  double min_resistance_Ohm = default_least_resistance_Ohm(10.0);  ///< below it: a short
  double short_s = 0.002;
  double off_current_A = 0.05;    ///< what the sense may show while the channel is off
  double current_noise_A = 0.01;  ///< between the sense and the true current, besides 5 %
  double stuck_on_s = 0.05;
  double responding_window_s = 20.0;
  double responding_ratio = 0.3;
  double responding_min_m = 0.001;
  bool proof_of_response = true;  ///< asked of an identified muscle while it is hot and still
  double wrong_duty_s = 0.005;
  // Muscle
  double trip_C = 160.0;
  double max_travel_m = 0.035;
  double energy_window_s = 60.0;
  double energy_J = default_energy_J(4.5, 60.0);  ///< within the window
  double resistance_ratio = 0.3;                  ///< drift of the cold resistance
  // Supply, of the channel
  double max_measured_W = default_max_measured_W(4.5);
  double over_power_s = 0.1;
  // Command
  double command_timeout_s = 0.25;
  int damaged_in_a_row = 10;
  int refused_in_a_row = 10;
  // Self
  double saturated_s = 120.0;  ///< limited without a gap for this long: the controller is lost
};

/// Thresholds of the detectors that concern the whole board.
struct BoardSupervision {
  double min_supply_V = 10.8;
  double max_supply_V = 13.2;
  double supply_s = 0.02;
  double late_s = 0.0005;  ///< a tick that wakes later is late
  int late_in_a_row = 5;
  int overruns_in_a_row = 5;          ///< periods left out, in one stall or several in a row
  double charge_pump_decay_s = 0.02;  ///< more than twice the tolerated overruns
  double telemetry_timeout_s = 0.5;
  double bus_off_s = 0.0;
  double bus_error_passive_s = 1.0;
};

}  // namespace supercoil
