// Doctor, as a step of setup.
#pragma once

#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/operator.hpp"
#include "apps/supercoil/setup/options.hpp"
#include "config/board_config.hpp"

namespace supercoil::operating {

/// Looks at this machine if it is the board's: of a board on a bus it says what to run there. Tells
/// what does not hold, and how much does; whatever it is, setup may go on.
StepResult doctor_step(const SetupOptions& options, const config::BoardConfig& config,
                       Operator& who);

}  // namespace supercoil::operating
