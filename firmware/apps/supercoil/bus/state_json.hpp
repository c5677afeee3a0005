// The bus as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/supercoil/bus/recent.hpp"

namespace supercoil::operating {

/// {"nodes":[{"node":1,"Status":{"state":"armed",…},…}]}: for each node on the bus the newest of
/// every message, with the names and units of the DBC. A value with a name is given as that name;
/// null: not available.
nlohmann::ordered_json state_json(const FrameHistory& frame_history);

}  // namespace supercoil::operating
