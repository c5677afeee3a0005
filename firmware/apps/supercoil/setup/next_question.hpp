// What describe asks next, by what the board's file and the answers so far already say.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "apps/supercoil/setup/muscle_answers.hpp"

namespace supercoil::operating {

/// Of the channel, as far as its file tells it; NaN: it does not.
struct BoardRanges {
  double min_supply_V = NAN;
  double max_position_m = NAN;  ///< in a joint the sensor reads something else
};
/// text: TOML in order, though the file need not be complete. channel: from 1.
BoardRanges board_ranges(const std::string& text, int channel);

/// A place in questions, with what is allowed after the answers before it.
Question next_question(std::size_t place, const MuscleAnswers& answers, const BoardRanges& board);

}  // namespace supercoil::operating
