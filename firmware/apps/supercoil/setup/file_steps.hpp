// The steps that need no running board.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/operator.hpp"
#include "apps/supercoil/setup/options.hpp"
#include "config/board_config.hpp"

namespace supercoil::operating {

/// What a person knows of the muscle goes into the board's file: asks, or takes what the script
/// answers if there is one; writes the file only if it is in order then. The error is whole lines.
Result<nlohmann::ordered_json> describe_step(const SetupOptions& options, Operator& who);

/// Looks at this machine if it is the board's: of a board on a bus it says what to run there. Tells
/// what does not hold, and how much does; whatever it is, setup may go on.
StepResult doctor_step(const SetupOptions& options, const config::BoardConfig& config,
                       Operator& who);

}  // namespace supercoil::operating
