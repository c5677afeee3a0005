// The bus as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/supercoil/bus/recent.hpp"

namespace supercoil::operating {

/// {"nodes":[{"node":1,"Status":{"state":"armed",…},…}]}: of each node that is heard the newest of
/// every message, by the names and in the units of the DBC. A value with a name is that name; what
/// is not available is null.
nlohmann::ordered_json state_json(const FrameHistory& frame_history);

}  // namespace supercoil::operating
