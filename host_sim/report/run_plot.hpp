// plot.svg: what one run looked like.
#pragma once

#include "plot/figure.hpp"
#include "runner/simulation.hpp"

namespace supercoil::host_sim {

/// Keeps about 2,000 ticks of a run, evenly spread, and draws position against reference, error,
/// power and estimates.
class RunPlot {
 public:
  explicit RunPlot(const Scenario& scenario);

  bool wants(long tick) const { return tick % every_ == 0; }
  void add(const TickRecord& record, const std::optional<control::Estimate>& estimate);
  Figure figure() const;

 private:
  const Scenario* scenario_;
  long every_;
  std::vector<TickRecord> records_;
  std::vector<control::Theta> theta_;
};

}  // namespace supercoil::host_sim
