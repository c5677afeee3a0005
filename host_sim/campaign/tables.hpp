// All runs of a study together.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "campaign/results.hpp"
#include "campaign/search.hpp"
#include "campaign/statistics.hpp"
#include "campaign/study.hpp"
#include "plot/figure.hpp"

namespace supercoil::host_sim::campaign {

/// A goal's quantity over a contender's runs that were not refused.
struct GoalRow {
  Goal goal;
  Rate failures;  ///< runs that miss it
  double median = 0.0;
  double of_95_in_100 = 0.0;  ///< 95 of 100 runs are not above
  double worst = 0.0;
  std::vector<double> decides;  ///< rank correlation with each draw; NaN: none
};

struct ContenderRow {
  std::string name;
  Rate refused;
  Rate failures;  ///< of those that were not refused: runs that miss any goal
  std::vector<GoalRow> goals;
  std::string reason;  ///< of a refusal, the first run's; empty without
};

std::vector<ContenderRow> table_of(const Study& study, const Draws& draws,
                                   const Outcomes& outcomes);

/// A contender's runs that miss their goals by most, worst first; no more than count. Only runs
/// that miss one.
std::vector<Key> worst_of(const Study& study, const Outcomes& outcomes, std::size_t contender,
                          std::size_t count);

/// A line a goal of a contender.
std::string to_csv(const std::vector<ContenderRow>& table);
/// What a person reads.
std::string to_markdown(const Study& study, const std::vector<ContenderRow>& table,
                        const Outcomes& outcomes);

/// campaign.svg: how each quantity with a goal is distributed, unless it is always the same, and
/// over the draw that it follows most.
Figure figure_of(const Study& study, const Draws& draws, const Outcomes& outcomes,
                 const std::vector<ContenderRow>& table);

/// What a search found, by contender.
std::string to_markdown(const Study& study, const std::map<std::size_t, Worst>& found);

}  // namespace supercoil::host_sim::campaign
