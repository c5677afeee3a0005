// Steps of a running channel that have a file of their own; Commission runs them.
#pragma once

#include <string>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/setup/channel_now.hpp"
#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/operator.hpp"

namespace supercoil::operating {

/// Tells what the controller in use and the one that suits the muscle are and promise. Where they
/// differ it asks, takes the recommended one over, and stores it for the next start. Nothing is
/// heated; whoever does not answer keeps what is in use.
StepResult choose_gains(BoardLink& board, const std::string& channel, const ChannelNow& now,
                        const BoardSettings& settings, Operator& who);

/// The key of a channel that the next step makes smaller.
inline constexpr const char* travel_key = "limits.max_travel_m";

/// Pulls slowly until somebody or something stops it. Of an armed channel, which is cold again
/// however this ends. What was found has travel_key, as a literal, where the limit becomes smaller.
StepResult find_travel_limit(BoardLink& board, const std::string& channel, const ChannelNow& now,
                             const BoardSettings& settings, Operator& who);

}  // namespace supercoil::operating
