#include "campaign/tables.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "batch/kept_lines.hpp"

namespace supercoil::host_sim::campaign {

namespace {

/// A contender's runs that were not refused.
struct Runs {
  std::vector<const Outcome*> outcomes;
  std::vector<std::vector<double>> drawn;  ///< draw by draw
};

Runs runs_of(std::size_t contender, const Study& study, const Draws& draws,
             const Outcomes& outcomes) {
  Runs runs;
  runs.drawn.resize(study.draws.size());
  for (const auto& [key, outcome] : outcomes) {
    if (key.contender != contender || !outcome.refused.empty()) continue;
    runs.outcomes.push_back(&outcome);
    const auto drawn = draws.of_run(key.run);
    for (std::size_t i = 0; i < drawn.size(); ++i)
      runs.drawn[i].push_back(drawn[i]);
  }
  return runs;
}

GoalRow row_of(const Goal& goal, const Runs& runs) {
  GoalRow row{goal, {}, NAN, NAN, NAN, {}};
  std::vector<double> values;
  std::int64_t missed = 0;
  for (const Outcome* outcome : runs.outcomes) {
    const double value = outcome->values.at(goal.quantity);
    // A value that was not measured counts as the worst.
    values.push_back(std::isnan(value) ? INFINITY : value);
    missed += values.back() > goal.max ? 1 : 0;
  }
  row.failures = rate_of(missed, static_cast<std::int64_t>(values.size()));
  row.median = quantile(values, 0.5);
  row.percentile_95 = quantile(values, 0.95);
  row.worst = quantile(values, 1.0);
  for (const auto& drawn : runs.drawn)
    row.rank_correlations.push_back(rank_correlation(drawn, values));
  return row;
}

constexpr std::size_t kept_worst = 10;

/// Only runs that miss a goal.
std::vector<Key> worst_of(const Study& study, const Outcomes& outcomes, std::size_t contender) {
  std::vector<std::pair<double, Key>> failed;
  for (const auto& [key, outcome] : outcomes) {
    if (key.contender != contender || !outcome.refused.empty()) continue;
    if (const double by = severity(study, outcome); by > 1.0) failed.emplace_back(-by, key);
  }
  std::ranges::sort(failed);
  std::vector<Key> worst;
  for (std::size_t i = 0; i < std::min(kept_worst, failed.size()); ++i)
    worst.push_back(failed[i].second);
  return worst;
}

}  // namespace

std::vector<ContenderRow> table_of(const Study& study, const Draws& draws,
                                   const Outcomes& outcomes) {
  std::vector<ContenderRow> table;
  for (std::size_t i = 0; i < study.contenders.size(); ++i) {
    const Runs runs = runs_of(i, study, draws, outcomes);
    ContenderRow row{study.contenders[i].name, {}, {}, {}, "", worst_of(study, outcomes, i)};
    std::int64_t all = 0;
    for (const auto& [key, outcome] : outcomes) {
      if (key.contender != i) continue;
      ++all;
      if (row.reason.empty()) row.reason = outcome.refused;
    }
    const auto ran = static_cast<std::int64_t>(runs.outcomes.size());
    const auto failed = std::ranges::count_if(
        runs.outcomes, [&](const Outcome* one) { return severity(study, *one) > 1.0; });
    row.refused = rate_of(all - ran, all);
    row.failures = rate_of(failed, ran);
    for (const Goal& goal : study.goals)
      row.goals.push_back(row_of(goal, runs));
    table.push_back(std::move(row));
  }
  return table;
}

std::string worst_name(const std::string& contender, std::size_t place) {
  return "worst-" + contender + "-" + std::to_string(place) + ".toml";
}

std::string to_csv(const std::vector<ContenderRow>& table) {
  std::string text =
      "controller,quantity,max,runs,failures,rate,ci95_low,ci95_high,median,p95,worst\n";
  const auto line = [&](const ContenderRow& row, const std::string& name, const std::string& max,
                        const Rate& rate, const std::string& rest) {
    text += row.name + "," + name + "," + max + "," + std::to_string(rate.runs) + "," +
            std::to_string(rate.failures) + "," + batch::number(rate.rate()) + "," +
            batch::number(rate.low) + "," + batch::number(rate.high) + rest + "\n";
  };
  for (const ContenderRow& row : table) {
    line(row, "refused", "", row.refused, ",,,");
    line(row, "any", "", row.failures, ",,,");
    for (const GoalRow& goal : row.goals) {
      line(row, std::string(quantity(goal.goal.quantity).name), batch::number(goal.goal.max),
           goal.failures,
           "," + batch::number(goal.median) + "," + batch::number(goal.percentile_95) + "," +
               batch::number(goal.worst));
    }
  }
  return text;
}

}  // namespace supercoil::host_sim::campaign
