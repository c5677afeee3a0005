// The tables over all runs of a study.
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
  double percentile_95 = 0.0;  ///< 95 of 100 runs are not above
  double worst = 0.0;
  std::vector<double> rank_correlations;  ///< rank correlation with each draw; NaN: none
};

struct ContenderRow {
  std::string name;
  Rate refused;
  Rate failures;  ///< of those that were not refused: runs that miss any goal
  std::vector<GoalRow> goals;
  std::string reason;  ///< of the first run that was refused; empty: none was
  /// The runs that miss their goals most, worst first; no more than ten.
  std::vector<Key> worst;
};

std::vector<ContenderRow> table_of(const Study& study, const Draws& draws,
                                   const Outcomes& outcomes);

/// One line per goal and contender.
std::string to_csv(const std::vector<ContenderRow>& table);
/// For people to read.
std::string to_markdown(const Study& study, const std::vector<ContenderRow>& table,
                        const Outcomes& outcomes);

/// report.html: the same, with what was asked, how to repeat the worst runs, and figure_of()'s
/// picture; svg: empty without one.
std::string to_html(const Study& study, const std::vector<ContenderRow>& table,
                    const Outcomes& outcomes, const std::string& svg);

/// campaign.svg: how each quantity with a goal is distributed, unless it is always the same, and
/// over the draw that it follows most.
Figure figure_of(const Study& study, const Draws& draws, const Outcomes& outcomes,
                 const std::vector<ContenderRow>& table);

/// The file with the contender's worst run of this rank, from 1.
std::string worst_name(const std::string& contender, std::size_t place);

/// What a search found, by contender.
std::string to_markdown(const Study& study, const std::map<std::size_t, WorstRun>& found);

}  // namespace supercoil::host_sim::campaign
