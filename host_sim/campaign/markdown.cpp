#include <algorithm>
#include <cmath>

#include "campaign/readable.hpp"
#include "campaign/tables.hpp"

namespace supercoil::host_sim::campaign {

namespace {

/// What the worst few runs missed; their scenarios are in files.
std::string worst_runs(const Study& study, const Outcomes& outcomes, const ContenderRow& row) {
  if (row.worst.empty()) return {};
  constexpr std::size_t max_listed = 3;
  std::string text = "\nThe worst runs of " + row.name + " (repeat them with " +
                     worst_name(row.name, 1) + " and following):\n\n";
  for (std::size_t i = 0; i < std::min(max_listed, row.worst.size()); ++i) {
    text += std::to_string(i + 1) + ". run " + std::to_string(row.worst[i].run + 1) + ", " +
            missed(study, outcomes.at(row.worst[i])) + "\n";
  }
  return text;
}

std::string cells(const std::vector<std::string>& texts) {
  std::string line = "|";
  for (const std::string& text : texts)
    line += " " + text + " |";
  return line + "\n";
}

}  // namespace

std::string to_markdown(const Study& study, const std::vector<ContenderRow>& table,
                        const Outcomes& outcomes) {
  std::string text = "# " + study.name +
                     "\n\nShares with their exact 95 % confidence intervals.\n\n" +
                     cells({"controller", "runs", "refused", "failed"}) + "|---|---|---|---|\n";
  for (const ContenderRow& row : table) {
    text += cells(
        {row.name, std::to_string(row.refused.runs), percent(row.refused), percent(row.failures)});
  }
  text += "\n" +
          cells({"controller", "quantity", "goal", "missed", "median", "95 of 100", "worst",
                 "correlates with (rank correlation)"}) +
          "|---|---|---|---|---|---|---|---|\n";
  for (const ContenderRow& row : table) {
    for (const GoalRow& goal : row.goals) {
      text += cells({row.name, std::string(quantity(goal.goal.quantity).name),
                     "≤ " + shown(goal.goal, goal.goal.max), percent(goal.failures),
                     shown(goal.goal, goal.median), shown(goal.goal, goal.percentile_95),
                     shown(goal.goal, goal.worst), deciding(study, goal)});
    }
  }
  std::string last_reason;
  for (const ContenderRow& row : table) {
    if (row.reason.empty() || row.reason == last_reason) continue;
    last_reason = row.reason;
    text += "\nFirst refusal: " + row.reason + "\n";
  }
  for (const ContenderRow& row : table)
    text += worst_runs(study, outcomes, row);
  return text;
}

std::string to_markdown(const Study& study, const std::map<std::size_t, WorstRun>& found) {
  std::string text = "# The worst runs of " + study.name + "\n\n" +
                     cells({"controller", "runs", "quantity", "goal", "worst found"}) +
                     "|---|---|---|---|---|\n";
  for (const auto& [contender, worst] : found) {
    const std::string& name = study.contenders[contender].name;
    for (const Goal& goal : study.goals) {
      const double value = worst.drawn.empty() ? NAN : worst.outcome.values.at(goal.quantity);
      text += cells({name, std::to_string(worst.runs), std::string(quantity(goal.quantity).name),
                     "≤ " + shown(goal, goal.max), shown(goal, value)});
    }
    if (!worst.outcome.fault.empty()) text += cells({name, "", "fault", "", worst.outcome.fault});
  }
  text += "\nsearch-CONTROLLER.toml repeats the run.\n";
  return text;
}

}  // namespace supercoil::host_sim::campaign
