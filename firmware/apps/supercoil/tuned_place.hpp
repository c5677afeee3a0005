// Finds a controller or estimator of a running board by its place or its kind.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "apps/common/exit_status.hpp"
#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/tuning_table.hpp"

namespace supercoil::operating {

/// channel: as in a line.
ReadTunable tunable_reader(BoardLink& board, const std::string& channel);

/// "0 (mrac), 1 (pi)"
std::string places_text(const std::vector<std::string>& kinds);

/// The place that a word means among the kinds in use: "1", or "pi" if there is only one. The error
/// lists what there is, with the code invalid_argument.
Result<std::size_t> find_place(Tuned what, std::string_view word,
                               const std::vector<std::string>& kinds);

/// The same for a running board.
Result<std::size_t> find_place(Tuned what, std::string_view word, const ReadTunable& read_value);

/// For `tune`, numbered as in Tuner: a number, or the kind of a controller or an estimator.
Result<std::size_t> find_any_place(std::string_view word, const ReadTunable& read_value);

/// A place that does not exist is a wrong input; a board that does not answer is not.
inline int exit_for(const Error& wrong_place) {
  return wrong_place.code == std::errc::invalid_argument ? exit_wrong_input : exit_failed;
}

}  // namespace supercoil::operating
