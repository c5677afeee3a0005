// Compares what identify found with the configuration.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "apps/supercoil/setup/operator.hpp"
#include "loop/known_muscle.hpp"
#include "loop/settings.hpp"

namespace supercoil::operating {

/// Prints lines for people; the return value is for programs.
nlohmann::ordered_json report_identified(const KnownMuscle& known,
                                         const ChannelSettings& configured, Operator& user);

}  // namespace supercoil::operating
