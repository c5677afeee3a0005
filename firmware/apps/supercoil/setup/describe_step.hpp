// The first step: what a person knows of the muscle goes into the board's file.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <tl/expected.hpp>

#include "apps/supercoil/setup/operator.hpp"
#include "apps/supercoil/setup/options.hpp"

namespace supercoil::operating {

/// Asks what the script does not answer, unless there is one; writes the file only if it is in
/// order then. The error is whole lines.
tl::expected<nlohmann::ordered_json, std::string> describe_step(const SetupOptions& options,
                                                                Operator& who);

}  // namespace supercoil::operating
