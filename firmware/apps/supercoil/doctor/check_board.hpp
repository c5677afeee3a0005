// Checks a whole board.
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
  std::string run_folder = "/run/supercoil";  ///< holds supercoild's lock
  std::string can;                            ///< an interface, e.g. can0; empty: that of [can]
};

/// Reports every finding. Opens devices only while it holds the lock, that is, while no supercoild
/// runs. Nothing is heated: duties stay 0, enable lines low, and the heartbeat has no edges.
void check_board(const config::BoardConfig& config, const CheckOptions& options,
                 const hal::FindingSink& sink);

/// The same for a machine that has no configuration yet: kernel, processor, rights, and which buses
/// and devices it has. Opens no device.
void check_machine(const CheckOptions& options, const hal::FindingSink& sink);

}  // namespace supercoil::doctor
