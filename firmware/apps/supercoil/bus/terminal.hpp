// The bus as text.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "apps/supercoil/bus/recent.hpp"

namespace supercoil::operating {

/// The place of the active controller, for each node on the bus.
std::map<int, int> active_controllers(const FrameHistory& frame_history);

/// The present state of every node, a few lines each. laws: the kinds of the active controllers, as
/// far as they are known: frames do not carry them.
std::string state_text(const FrameHistory& frame_history,
                       const std::map<int, std::string>& controller_kinds = {});

/// Redraws it five times a second on a terminal, once a second elsewhere, until `ended`; shows a
/// log once. Returns the exit status; a program reports output that was not written at its end.
int show_on_terminal(const FrameHistory& frame_history, bool log,
                     const std::function<bool()>& ended);

}  // namespace supercoil::operating
