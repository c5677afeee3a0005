// Steps of a running channel that have their own files; Commission runs them.
#pragma once

#include <string>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/setup/channel_now.hpp"
#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/operator.hpp"

namespace supercoil::operating {

/// Reports the controller in use and the one recommended for the muscle, with their promises. If
/// they differ it asks, takes the recommended one over, and stores it for the next start. Nothing
/// is heated; without an answer the one in use is kept.
StepResult choose_gains(BoardLink& board, const std::string& channel, const ChannelNow& now,
                        const BoardSettings& settings, Operator& user);

/// The channel's key that the next step makes smaller.
inline constexpr const char* travel_key = "limits.max_travel_m";

/// Pulls an armed channel slowly until somebody or something stops it; it is cold again however
/// this ends. The result has travel_key, as a literal, if the limit becomes smaller.
StepResult find_travel_limit(BoardLink& board, const std::string& channel, const ChannelNow& now,
                             const BoardSettings& settings, Operator& user);

}  // namespace supercoil::operating
