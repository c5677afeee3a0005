// What a board would have accepted instead of a value that it refused as out of range.
#pragma once

#include <string>

#include "apps/supercoil/board_link.hpp"
#include "loop/command.hpp"

namespace supercoil::operating {

/// For scale, controller and estimator: "; there are 0 (learned_ff), 1 (pi)". Empty: for another
/// command, or the board does not tell. channel: as in a line.
std::string accepted_range_text(BoardLink& board, const std::string& channel, Verb verb);

}  // namespace supercoil::operating
