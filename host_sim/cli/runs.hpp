// The two ways in which scenarios run. Each returns the program's exit status.
#pragma once

#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/learned_folder.hpp"
#include "report/output_folder.hpp"
#include "runner/summary.hpp"

namespace supercoil::host_sim {

/// Name of the boards on one bus: "s", or "a+b".
std::string name_of(const std::vector<Scenario>& boards);

/// As fast as it can; writes what the options want.
int lockstep_run(const RunOptions& options, const std::vector<Scenario>& boards,
                 const Window& window, OutputFolder& folder, LearnedFolder& learned);

/// In real time, with its CAN bus served to other programs; until its end or a signal.
int live_run(const RunOptions& options, const std::vector<Scenario>& boards, const Window& window,
             OutputFolder& folder, LearnedFolder& learned);

}  // namespace supercoil::host_sim
