// What identify found, beside what was configured.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "apps/supercoil/setup/operator.hpp"
#include "loop/known_muscle.hpp"
#include "loop/settings.hpp"

namespace supercoil::operating {

/// Lines for people; what it returns is for programs.
nlohmann::ordered_json tell_identified(const KnownMuscle& known, const ChannelSettings& configured,
                                       Operator& who);

}  // namespace supercoil::operating
