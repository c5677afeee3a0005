// The two ways in which a scenario runs. Each returns the program's exit status.
#pragma once

#include "cli/commands.hpp"
#include "cli/learned_folder.hpp"
#include "report/output_folder.hpp"
#include "runner/summary.hpp"

namespace supercoil::host_sim {

/// As fast as it can; writes what the options want.
int lockstep_run(const RunOptions& options, const Scenario& scenario, const Window& window,
                 OutputFolder& folder, LearnedFolder& learned);

/// In real time, with its CAN bus served to other programs; until its end or a signal.
int live_run(const RunOptions& options, const Scenario& scenario, const Window& window,
             OutputFolder& folder, LearnedFolder& learned);

}  // namespace supercoil::host_sim
