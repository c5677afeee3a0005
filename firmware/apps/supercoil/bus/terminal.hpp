// The bus as text.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "apps/supercoil/bus/recent.hpp"

namespace supercoil::operating {

/// Of each node that is heard the place of the controller that is at work.
std::map<int, int> controllers_at_work(const FrameHistory& frame_history);

/// What is known of every node now, some lines each. laws: the kinds of those controllers, as far
/// as they are known: frames do not tell them.
std::string state_text(const FrameHistory& frame_history,
                       const std::map<int, std::string>& laws = {});

/// Shows it anew five times a second on a terminal, once a second elsewhere, until `ended`; of a
/// log once. Returns the exit status.
int show_on_terminal(const FrameHistory& frame_history, bool log,
                     const std::function<bool()>& ended);

}  // namespace supercoil::operating
