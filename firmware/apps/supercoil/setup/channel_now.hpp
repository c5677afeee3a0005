// A channel as its board uses it now: the muscle that it found, and its tuning.
#pragma once

#include <optional>
#include <string>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/board_link.hpp"
#include "loop/promise.hpp"
#include "loop/settings.hpp"

namespace supercoil::operating {

struct ChannelNow {
  /// With the known muscle and senses. Its first controller has the values in use.
  ChannelSettings settings;

  bool in_joint() const { return settings.joint.has_other(); }
  /// The promise of a controller in place of the first; empty: its law promises no error, or the
  /// muscle turns a joint.
  std::optional<Promise> promise(const control::ControllerSettings& controller,
                                 const BoardSettings& board, const FirstMotion& motion) const;
};

/// channel: as in a line of a command. configured: from the board's file.
Result<ChannelNow> channel_now(BoardLink& board, const std::string& channel,
                               const ChannelSettings& configured);

}  // namespace supercoil::operating
