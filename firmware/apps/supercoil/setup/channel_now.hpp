// A channel as its board goes by it now: what it found, and what it was tuned to.
#pragma once

#include <optional>
#include <string>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/board_link.hpp"
#include "loop/promise.hpp"
#include "loop/settings.hpp"

namespace supercoil::operating {

struct ChannelNow {
  /// With the muscle and the senses that are known. Its first controller is as it is in use.
  ChannelSettings settings;

  bool in_joint() const { return settings.joint.has_other(); }
  /// Of a controller in the place of the first; empty: its law promises none, or the muscle turns a
  /// joint.
  std::optional<Promise> promise(const control::ControllerSettings& controller,
                                 const BoardSettings& board, const FirstMotion& motion) const;
};

/// channel: as in a line of a command. configured: as the board's file has it.
Result<ChannelNow> channel_now(BoardLink& board, const std::string& channel,
                               const ChannelSettings& configured);

}  // namespace supercoil::operating
