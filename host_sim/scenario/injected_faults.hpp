// Faults that can be injected into a simulated board, by name.
#pragma once

#include <array>

namespace supercoil::host_sim {

struct InjectedFaults {
  bool heater_open = false;      ///< a wire of the muscle is broken
  bool heater_short = false;     ///< half an ohm across the muscle
  bool switch_stuck_on = false;  ///< the power switch conducts whatever it is commanded
  bool position_loose = false;   ///< the sensor's wire is off
  bool position_silent = false;  ///< no new readings
  bool position_frozen = false;  ///< the same reading again and again
  bool muscle_slack = false;     ///< heat no longer moves the sensor's end
  bool pwm_refuses = false;      ///< the PWM device answers with an error
  bool stop_pressed = false;     ///< the emergency stop's circuit is open
  bool commands_stop = false;    ///< the master falls silent
  bool agonist_torn = false;     ///< in a joint: the muscle no longer pulls
  bool antagonist_torn = false;  ///< likewise
  bool antagonist_heater_open = false;
  double current_gain = 1.0;       ///< reading of the current sense over the true current
  double supply_gain = 1.0;        ///< likewise for the supply sense
  double switch_leak_ratio = 0.0;  ///< of full conduction, while the power switch is off
  double agonist_slack_m = 0.0;    ///< in a joint: contraction that is lost before it pulls
  double antagonist_slack_m = 0.0;
  double open_heater_in_bundle = 0.0;  ///< the number of the muscle whose wire is broken; 0: none

  friend bool operator==(const InjectedFaults&, const InjectedFaults&) = default;
};

/// What a scenario must have for a fault to be possible.
enum class Needs { muscle, joint, antagonist, bundle };

struct InjectedFaultName {
  const char* name;  ///< as in [injected_fault]
  bool InjectedFaults::*member;
  Needs needs = Needs::muscle;
};
inline constexpr std::array<InjectedFaultName, 13> injected_fault_names{{
    {"heater_open", &InjectedFaults::heater_open},
    {"heater_short", &InjectedFaults::heater_short},
    {"switch_stuck_on", &InjectedFaults::switch_stuck_on},
    {"position_loose", &InjectedFaults::position_loose},
    {"position_silent", &InjectedFaults::position_silent},
    {"position_frozen", &InjectedFaults::position_frozen},
    {"muscle_slack", &InjectedFaults::muscle_slack},
    {"pwm_refuses", &InjectedFaults::pwm_refuses},
    {"stop_pressed", &InjectedFaults::stop_pressed},
    {"commands_stop", &InjectedFaults::commands_stop},
    {"agonist_torn", &InjectedFaults::agonist_torn, Needs::joint},
    {"antagonist_torn", &InjectedFaults::antagonist_torn, Needs::antagonist},
    {"antagonist_heater_open", &InjectedFaults::antagonist_heater_open, Needs::antagonist},
}};

struct InjectedFaultNumber {
  const char* name;
  double InjectedFaults::*member;
  double min;
  double max;
  Needs needs = Needs::muscle;
};
inline constexpr std::array<InjectedFaultNumber, 6> injected_fault_numbers{{
    {"current_gain", &InjectedFaults::current_gain, 0.0, 10.0},
    {"supply_gain", &InjectedFaults::supply_gain, 0.0, 10.0},
    {"switch_leak_ratio", &InjectedFaults::switch_leak_ratio, 0.0, 1.0},
    {"agonist_slack_m", &InjectedFaults::agonist_slack_m, 0.0, 1.0, Needs::joint},
    {"antagonist_slack_m", &InjectedFaults::antagonist_slack_m, 0.0, 1.0, Needs::antagonist},
    {"open_heater_in_bundle", &InjectedFaults::open_heater_in_bundle, 0.0, 8.0, Needs::bundle},
}};

}  // namespace supercoil::host_sim
