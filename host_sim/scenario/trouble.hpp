// What can break on a simulated board, by name.
#pragma once

#include <array>

namespace supercoil::host_sim {

struct Trouble {
  bool heater_open = false;        ///< a wire of the muscle is broken
  bool heater_short = false;       ///< half an ohm across the muscle
  bool switch_stuck_on = false;    ///< the power switch conducts whatever it is told
  bool position_loose = false;     ///< the sensor's wire is off
  bool position_silent = false;    ///< no new readings
  bool position_frozen = false;    ///< the same reading again and again
  bool muscle_slack = false;       ///< heat no longer moves the sensor's end
  bool pwm_refuses = false;        ///< the PWM device answers with an error
  bool stop_pressed = false;       ///< the emergency stop's circuit is open
  bool commands_stop = false;      ///< whoever commands falls silent
  double current_gain = 1.0;       ///< what the current's sense reads, over the truth
  double supply_gain = 1.0;        ///< likewise of the supply's
  double switch_leak_ratio = 0.0;  ///< of full conduction, while the power switch is off

  friend bool operator==(const Trouble&, const Trouble&) = default;
};

struct TroubleName {
  const char* name;  ///< as in [trouble]
  bool Trouble::*member;
};
inline constexpr std::array<TroubleName, 10> trouble_names{{
    {"heater_open", &Trouble::heater_open},
    {"heater_short", &Trouble::heater_short},
    {"switch_stuck_on", &Trouble::switch_stuck_on},
    {"position_loose", &Trouble::position_loose},
    {"position_silent", &Trouble::position_silent},
    {"position_frozen", &Trouble::position_frozen},
    {"muscle_slack", &Trouble::muscle_slack},
    {"pwm_refuses", &Trouble::pwm_refuses},
    {"stop_pressed", &Trouble::stop_pressed},
    {"commands_stop", &Trouble::commands_stop},
}};

struct TroubleNumber {
  const char* name;
  double Trouble::*member;
  double min;
  double max;
};
inline constexpr std::array<TroubleNumber, 3> trouble_numbers{{
    {"current_gain", &Trouble::current_gain, 0.0, 10.0},
    {"supply_gain", &Trouble::supply_gain, 0.0, 10.0},
    {"switch_leak_ratio", &Trouble::switch_leak_ratio, 0.0, 1.0},
}};

}  // namespace supercoil::host_sim
