// Changes a controller of a running board: prepared value by value, then taken over.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/board_link.hpp"

namespace supercoil::operating {

struct TuningChange {
  std::size_t tunable;  ///< place in control::tunables()
  double value;
};

/// The error: what was refused, and why.
using TuningDone = Result<void>;

/// from: the set to change, one of tuning_set_names. changes: in the order of control::tunables().
TuningDone prepare_tuning(BoardLink& board, const std::string& channel, int place,
                          const std::string& from, const std::vector<TuningChange>& changes);
/// Sends a line that takes over, stores or forgets: "1 tune 0", "1 store tuning", "1 clear tuning".
TuningDone send_tuning_command(BoardLink& board, const std::string& line);

}  // namespace supercoil::operating
