// What boards have to agree on to share a CAN bus.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "cli/commands.hpp"
#include "config/diagnostics.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// "sine, node 1", as the results of one among several are called.
std::string name_on_bus(const Scenario& board);

/// The options' scenarios as boards of one bus: copies of the only one (--nodes), or one for each
/// scenario. Each has nodes and noise of its own. scenarios: as they were read, with the boards'
/// files. The error names the option or the file that does not go with the others.
tl::expected<std::vector<Scenario>, Errors> on_one_bus(const RunOptions& options,
                                                       std::vector<Scenario> scenarios);

}  // namespace supercoil::host_sim
