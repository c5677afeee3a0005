// Whether a board runs with the file that setup uses.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/supercoil/board_link.hpp"
#include "loop/known_muscle.hpp"
#include "loop/settings.hpp"

namespace supercoil::operating {

/// "muscle.stiffness_N_per_m = 17.84 (the board: 21.8)" for each key with another value when the
/// board was started. channel: of the file, from 0.
std::vector<std::string> differences(const KnownMuscle& board, const BoardSettings& file,
                                     std::size_t channel);

/// The same in one line, also for channels heated with this one. Empty: the board runs with the
/// file. first: address of the file's first channel, as in a line. The error: no answer.
BoardLink::Answer differences_of_board(BoardLink& board, int first, const BoardSettings& file,
                                       std::size_t channel);

/// Channels, from 0, that are calibrated and armed with this one, including itself.
std::vector<std::size_t> heated_together(const BoardSettings& board, std::size_t channel);

}  // namespace supercoil::operating
