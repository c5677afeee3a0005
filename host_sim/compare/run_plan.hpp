// Carries runs out on several threads.
#pragma once

#include <functional>
#include <vector>

#include "compare/plan.hpp"
#include "compare/result.hpp"

namespace supercoil::host_sim::compare {

struct Listener {
  /// A run has ended; called one at a time, in the order in which they end.
  std::function<void(const Run&, const Result&)> ended;
  /// Called several times a second; if it returns true, unfinished runs are given up.
  std::function<bool()> stop;
};

/// Carries the runs out. A run's result does not depend on how many jobs there are, or on their
/// order. jobs >= 1. Throws what a run or ended() threw.
void run_plan(const std::vector<Case>& cases, const std::vector<Run>& runs, unsigned jobs,
              const Listener& listener);

}  // namespace supercoil::host_sim::compare
