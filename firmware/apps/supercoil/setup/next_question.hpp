// What describe asks next, given the board's file and the answers so far.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "apps/supercoil/setup/muscle_answers.hpp"

namespace supercoil::operating {

/// Ranges of the channel, as far as its file tells them; NaN: not told.
struct BoardRanges {
  double min_supply_V = NAN;
  double max_position_m = NAN;  ///< in a joint the sensor reads something else
};
/// text: valid TOML, though the file need not be complete. channel: from 1.
BoardRanges board_ranges(const std::string& text, int channel);

/// The question at this place, with the range that the earlier answers allow.
Question next_question(std::size_t place, const MuscleAnswers& answers, const BoardRanges& board);

}  // namespace supercoil::operating
