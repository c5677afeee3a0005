// What boards have to agree on to share a CAN bus.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "cli/commands.hpp"
#include "config/diagnostics.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// "sine, node 1": the name of one board's results among several.
std::string name_on_bus(const Scenario& board);

/// The options' scenarios as boards of one bus: copies of a single one (--nodes), or one board per
/// scenario. Each has its own nodes and noise. scenarios: as they were read, with the boards'
/// files. The error names the option or the file that conflicts with the others.
tl::expected<std::vector<Scenario>, Errors> on_one_bus(const RunOptions& options,
                                                       std::vector<Scenario> scenarios);

}  // namespace supercoil::host_sim
