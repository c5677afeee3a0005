// The board that a scenario describes: the simulated one, and its firmware's configuration.
#pragma once

#include "loop/settings.hpp"
#include "scenario/scenario.hpp"
#include "simulated_board/simulated_board.hpp"

namespace supercoil::host_sim {

SimulatedBoardSettings simulated_board_of(const Scenario& scenario);
MuscleChannelSettings muscle_channel_of(const Scenario& scenario, const Conditions& conditions);

/// Of conditions with a joint: its antagonist's channel, and what the two of them turn.
MuscleChannelSettings antagonist_channel_of(const Scenario& scenario, const Conditions& conditions);
/// Of a bundle: place from 1, the muscle beside the first one.
MuscleChannelSettings companion_channel_of(const Scenario& scenario, const Conditions& conditions,
                                           std::size_t place);
SimulatedJointSettings simulated_joint_of(const Conditions& conditions);

/// One channel, an agonist's and its antagonist's, or a bundle's. Its controllers and estimators
/// are those of the start and of each event that names one, in that order.
BoardSettings firmware_of(const Scenario& scenario);
/// The same with what the simulation knows of the first channel's muscle: to tell beforehand what
/// it will do.
BoardSettings forecast_board_of(const Scenario& scenario);

}  // namespace supercoil::host_sim
