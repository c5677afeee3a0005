// The fault cases by what breaks, and what they have in common.
#pragma once

#include <utility>
#include <vector>

#include "loop/matrix/fault_case.hpp"

namespace supercoil::test {

std::vector<FaultCase> sensor_cases();
std::vector<FaultCase> heater_cases();
std::vector<FaultCase> muscle_cases();
std::vector<FaultCase> board_cases();
/// On a board of a joint only.
std::vector<FaultCase> joint_cases();
std::vector<FaultCase> command_cases();

/// The muscle gets no power, or almost none.
inline const std::vector<Situation> cold{Situation::disarmed, Situation::arming, Situation::armed,
                                         Situation::calibrate, Situation::fault};

/// The tested muscle becomes another one.
inline host_sim::MuscleChannelSettings ordinary_muscle() {
  return rough_board().board.channels[Rig::tested];
}
inline void resistance(Rig& rig, double resistance_Ohm) {
  host_sim::MuscleChannelSettings settings = ordinary_muscle();
  settings.resistance_Ohm = resistance_Ohm;
  rig.muscle().set(settings);
}

/// Faults that persist, and their end.
inline void every_tick(Rig& rig, std::function<void()> what) {
  rig.before_tick = std::move(what);
}
inline void nothing_more(Rig& rig) {
  rig.before_tick = [] {};
}

}  // namespace supercoil::test
