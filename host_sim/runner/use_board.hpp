// A scenario's muscle, or its joint, on the user's own board.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "supercoil/hal/error.hpp"

#include "config/board_config.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// Lets the scenario run the firmware as this file configures one of its channels, or that
/// channel's joint, over devices that measure and switch like the file's. Muscle, air, supply and
/// commands stay the scenario's. channel: from 0; either one of a joint. On the bus, the
/// antagonist's node follows the agonist's. The error says whether the file or the scenario must
/// change, and how.
Result<void> use_board(Scenario& scenario, const config::BoardConfig& config, std::size_t channel,
                       const LearnedMuscles& learned = {});

}  // namespace supercoil::host_sim
