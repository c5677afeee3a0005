// A scenario's muscle, or its joint, on a board of the user's own.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "supercoil/hal/error.hpp"

#include "config/board_config.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// Lets the scenario run the firmware as this file configures one of its channels, or the joint in
/// which that is, over devices that measure and switch as the file's do. The muscle, its air, the
/// supply and what is asked for stay the scenario's. channel: from 0, of a joint either one; on the
/// bus its antagonist's node follows the agonist's. The error says which of the two must change,
/// and how.
Result<void> use_board(Scenario& scenario, const config::BoardConfig& config, std::size_t channel,
                       const LearnedMuscles& learned = {});

}  // namespace supercoil::host_sim
