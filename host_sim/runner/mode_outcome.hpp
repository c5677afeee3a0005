// How a scenario's identify or calibrate ended, in words.
#pragma once

#include <string>

#include "runner/simulation.hpp"

namespace supercoil::host_sim {

/// "too_little_motion: the muscle moved by less than 1 % ... (see running in ...)"; empty:
/// there was none.
std::string describe_mode(const Snapshot& snapshot);

/// The same for an identify or calibrate of the scenario that found nothing or has not ended;
/// empty: none.
std::string mode_failed_because(const Scenario& scenario, const Simulation& simulation);

}  // namespace supercoil::host_sim
