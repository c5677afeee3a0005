// Looks at a whole board.
#pragma once

#include <string>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/checks.hpp"
#include "supercoil/hal_linux/machine.hpp"

#include "config/board_config.hpp"

namespace supercoil::doctor {

struct CheckOptions {
  hal_linux::Machine machine;
  hal_linux::LoopThreadSettings loop;
  std::string run_folder = "/run/supercoil";  ///< of supercoild's lock
  std::string can;                            ///< an interface, e.g. can0; empty: that of [can]
};

/// Tells every finding. Opens devices only while it holds the lock, that is, while no supercoild
/// runs. Nothing is heated: duties stay 0, enable lines low, the heartbeat has no edge.
void check_board(const config::BoardConfig& config, const CheckOptions& options,
                 const hal::FindingSink& sink);

/// The same of a machine that has no configuration yet: kernel, processor, rights, and what buses
/// and devices it has. Opens none.
void check_machine(const CheckOptions& options, const hal::FindingSink& sink);

}  // namespace supercoil::doctor
