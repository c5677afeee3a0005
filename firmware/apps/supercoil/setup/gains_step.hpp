// The step that compares the controller in use with the one that suits the muscle that was found.
#pragma once

#include <string>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/setup/channel_now.hpp"
#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/operator.hpp"

namespace supercoil::operating {

/// Tells what both are and promise. Where they differ it asks, takes the recommended one over, and
/// stores it for the next start. Nothing is heated; whoever does not answer keeps what is in use.
StepResult choose_gains(BoardLink& board, const std::string& channel, const ChannelNow& now,
                        const BoardSettings& settings, Operator& who);

}  // namespace supercoil::operating
