// Which controller or estimator of a running board is meant: by its place or its kind.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/tuning_table.hpp"

namespace supercoil::operating {

/// channel: as in a line.
AskTuning ask_tuning(BoardLink& board, const std::string& channel);

/// "0 (mrac), 1 (pi)"
std::string places_text(const std::vector<std::string>& kinds);

/// What a word means among the kinds that are in use, by their places: "1", or "pi" where there is
/// but one. The error says what there is.
tl::expected<std::size_t, std::string> find_place(Tuned what, std::string_view word,
                                                  const std::vector<std::string>& kinds);

struct WrongPlace {
  std::string why;
  bool no_answer = false;  ///< of the board; else there is no such place
};
/// The same of a running board.
tl::expected<std::size_t, WrongPlace> find_place(Tuned what, std::string_view word,
                                                 const AskTuning& ask);

/// Of the command `tune`, as Tuner counts: its number, or the kind of a controller or an estimator.
tl::expected<std::size_t, WrongPlace> find_any_place(std::string_view word, const AskTuning& ask);

}  // namespace supercoil::operating
