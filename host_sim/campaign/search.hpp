// Search for the worst run that a study's draws allow.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "campaign/draws.hpp"
#include "campaign/outcome.hpp"
#include "campaign/study.hpp"

namespace supercoil::host_sim::campaign {

struct WorstRun {
  std::vector<double> drawn;  ///< as from Draws::at(); empty: no run had a valid scenario
  Outcome outcome;
  double severity = 0.0;  ///< as from severity()
  std::int64_t runs = 0;  ///< until the search ended
};

/// Controlled random search with local mutation (Kaelo and Ali, 2006; NLopt's CRS2_LM) over all
/// draws, for the run in which this contender misses its goals most, with one run's sensor noise.
/// Ends after `runs` runs, or when nothing can be worse. The study's seed determines the start: the
/// same study gives the same result. ran: called after each run, on the calling thread. Throws
/// std::runtime_error if NLopt fails.
WorstRun search(const Study& study, const Draws& draws, std::size_t contender, std::int64_t runs,
                const std::atomic<bool>& stop, const std::function<void()>& ran);

}  // namespace supercoil::host_sim::campaign
