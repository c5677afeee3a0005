// The board that a scenario describes: the simulated one, and its firmware's configuration.
#pragma once

#include "loop/settings.hpp"
#include "scenario/scenario.hpp"
#include "simulated_board/simulated_board.hpp"

namespace supercoil::host_sim {

SimulatedBoardSettings simulated_board_of(const Scenario& scenario);
MuscleChannelSettings muscle_channel_of(const Scenario& scenario, const Conditions& conditions);

/// For a joint of two muscles: its antagonist's channel.
MuscleChannelSettings antagonist_channel_of(const Scenario& scenario, const Conditions& conditions);
/// For a bundle: the channel of another muscle. place: from 1, the muscle after the first.
MuscleChannelSettings companion_channel_of(const Scenario& scenario, const Conditions& conditions,
                                           std::size_t place);
SimulatedJointSettings simulated_joint_of(const Conditions& conditions);

/// The scenario's board file with the simulated converters' scaling; without a file, a board with
/// one channel, a joint's two, or a bundle's, whose controllers and estimators are those of the
/// start and of each event that names one, in that order.
BoardSettings firmware_of(const Scenario& scenario);
/// The same, with what the simulation knows of the first channel's muscle: for the forecast of a
/// run.
BoardSettings forecast_board_of(const Scenario& scenario);

}  // namespace supercoil::host_sim
