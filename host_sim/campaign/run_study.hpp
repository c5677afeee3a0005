// The runs of a study, on as many threads as wanted.
#pragma once

#include <functional>
#include <vector>

#include "campaign/results.hpp"

namespace supercoil::host_sim::campaign {

struct Listener {
  /// A run has ended; called one at a time, in the order in which they end.
  std::function<void(const Key&, const Outcome&)> ended;
  /// Asked several times a second; true gives up what still runs.
  std::function<bool()> stop;
};

/// Carries the runs out. A run's outcome does not depend on how many jobs there are, or on their
/// order. jobs >= 1. Throws what a run or ended() threw.
void run(const Study& study, const Draws& draws, const std::vector<Key>& runs, unsigned jobs,
         const Listener& listener);

}  // namespace supercoil::host_sim::campaign
