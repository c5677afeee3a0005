// A channel's line in the answer to "state" on the board's socket.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace supercoil {

/// The words in their order. Numbers are NaN when not known; notes are "-" when there are none. The
/// next two are the place and the kind ("-" when not known) of the active controller, and the last
/// one is "slack" for a joint's muscle that is slack, "-" otherwise; an older board omits these
/// three.
inline constexpr std::array<std::string_view, 16> state_words{
    "channel",         "state",     "mode",      "fault",    "reference", "model_m", "position_m",
    "applied_W",       "coldest_C", "hottest_C", "progress", "result",    "notes",   "controller",
    "controller_kind", "slack"};

/// Positions of the words that are looked up one by one.
enum StatePlace : std::uint8_t {
  state_mode = 2,
  state_first_number = 4,
  state_model = 5,
  state_position = 6,
  state_progress = 10,
  state_result = 11,
  state_notes = 12,
  state_controller = 13,
  state_controller_kind = 14,
  state_slack = 15,
};

}  // namespace supercoil
