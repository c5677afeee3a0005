// The bus as text.
#pragma once

#include <functional>
#include <string>

#include "apps/supercoil/bus/recent.hpp"

namespace supercoil::operating {

/// What is known of every node now, some lines each.
std::string state_text(const FrameHistory& frame_history);

/// Shows it anew five times a second on a terminal, once a second elsewhere, until `ended`; of a
/// log once. Returns the exit status.
int show_on_terminal(const FrameHistory& frame_history, bool log,
                     const std::function<bool()>& ended);

}  // namespace supercoil::operating
