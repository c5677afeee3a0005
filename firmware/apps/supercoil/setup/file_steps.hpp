// The steps that need no running board.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/operator.hpp"
#include "apps/supercoil/setup/options.hpp"
#include "config/board_config.hpp"

namespace supercoil::operating {

/// Puts what a person knows of the muscle into the board's file: asks, or uses a script's answers
/// if there is one; writes the file only if it is valid then. The error consists of whole lines.
Result<nlohmann::ordered_json> describe_step(const SetupOptions& options, Operator& user);

/// Checks this machine if it is the board; for a board on a bus it says what to run there. Reports
/// what failed, and how much passed; setup may go on in any case.
StepResult doctor_step(const SetupOptions& options, const config::BoardConfig& config,
                       Operator& user);

}  // namespace supercoil::operating
