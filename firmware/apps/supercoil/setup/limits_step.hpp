// The step that finds how far a muscle may move: it pulls slowly until somebody or something stops
// it.
#pragma once

#include <string>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/setup/channel_now.hpp"
#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/operator.hpp"

namespace supercoil::operating {

/// The key of a channel that this step makes smaller.
inline constexpr const char* travel_key = "limits.max_travel_m";

/// Of an armed channel, which is cold again however this ends. What was found has travel_key, as a
/// literal, where the limit becomes smaller.
StepResult find_travel_limit(BoardLink& board, const std::string& channel, const ChannelNow& now,
                             const BoardSettings& settings, Operator& who);

}  // namespace supercoil::operating
