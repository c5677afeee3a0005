// plot.svg: what one run looked like.
#pragma once

#include <cstdint>

#include "plot/figure.hpp"
#include "runner/simulation.hpp"

namespace supercoil::host_sim {

/// Keeps about 2,000 ticks of a run, evenly spread, and draws position against reference, error,
/// power and estimates.
class RunPlot {
 public:
  explicit RunPlot(const Scenario& scenario);

  bool is_due(std::int64_t tick) const { return tick % every_ == 0; }
  void add(const TickRecord& record, const std::optional<control::Estimate>& estimate);
  Figure figure() const;

 private:
  const Scenario* scenario_;
  std::int64_t every_;
  std::vector<TickRecord> records_;
  std::vector<control::Theta> theta_;
};

}  // namespace supercoil::host_sim
