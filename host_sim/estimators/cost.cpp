#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include "estimators/results.hpp"

namespace supercoil::host_sim::estimators {

Costs measure_costs() {
  using Clock = std::chrono::steady_clock;
  constexpr int steps = 2000;
  constexpr int attempts = 20;
  Bench bench(trials[0], 1);
  std::vector<Bench::Tick> ticks;
  ticks.reserve(steps);
  for (int i = 0; i < steps; ++i)
    ticks.push_back(bench.next());
  Costs costs{};
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    costs[i] = std::numeric_limits<double>::infinity();
    for (int attempt = 0; attempt < attempts; ++attempt) {
      const auto contender = contenders[i].make(trials[0].initial(), tick_s);
      const auto begin = Clock::now();
      for (const Bench::Tick& tick : ticks)
        contender->step(tick.position_m, tick.power_W);
      const std::chrono::duration<double, std::nano> taken = Clock::now() - begin;
      costs[i] = std::min(costs[i], taken.count() / steps);
    }
  }
  return costs;
}

}  // namespace supercoil::host_sim::estimators
