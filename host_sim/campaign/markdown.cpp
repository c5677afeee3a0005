#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "campaign/tables.hpp"

namespace supercoil::host_sim::campaign {

namespace {

/// Three digits, as a reader wants them.
std::string brief(double value) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return "∞";
  std::array<char, 32> text{};
  constexpr double of_four_digits = 999.5;
  constexpr double of_eight_digits = 1e8;
  const bool whole = std::abs(value) >= of_four_digits && std::abs(value) < of_eight_digits;
  std::snprintf(text.data(), text.size(), whole ? "%.0f" : "%.3g", value);
  return text.data();
}

/// A value of the goal's quantity, with its unit.
std::string shown(const Goal& goal, double value) {
  if (std::isnan(value)) return brief(value);
  const std::string_view name = quantity(goal.quantity).name;
  constexpr double um_per_m = 1e6;
  if (name.ends_with("_m")) return brief(um_per_m * value) + " µm";
  if (name.ends_with("_K")) return brief(value) + " K";
  if (name.ends_with("_C")) return brief(value) + " °C";
  if (name.ends_with("_s")) return brief(value) + " s";
  return brief(value);
}

std::string percent(const Rate& rate) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.2f %% (%.2f to %.2f)", 100.0 * rate.rate(),
                100.0 * rate.low, 100.0 * rate.high);
  return text.data();
}

/// What the quantity follows most, with the sign of it: no more than three.
std::string deciding(const Study& study, const GoalRow& row) {
  std::vector<std::size_t> order;
  // Chance alone gives this to less than 3 draws in 1000.
  const double least =
      3.0 / std::sqrt(static_cast<double>(std::max<std::int64_t>(1, row.failures.runs)));
  for (std::size_t i = 0; i < row.decides.size(); ++i) {
    if (std::abs(row.decides[i]) > least) order.push_back(i);
  }
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::abs(row.decides[a]) > std::abs(row.decides[b]);
  });
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, order.size()); ++i) {
    text += (text.empty() ? "" : ", ") + study.draws[order[i]].name + " " +
            brief(row.decides[order[i]]);
  }
  return text.empty() ? "–" : text;
}

/// What the few worst missed; their scenarios are in files.
std::string worst_runs(const Study& study, const Outcomes& outcomes, std::size_t contender) {
  constexpr std::size_t told = 3;
  const std::string& name = study.contenders[contender].name;
  std::string text;
  const auto worst = worst_of(study, outcomes, contender, told);
  for (std::size_t i = 0; i < worst.size(); ++i) {
    const Outcome& outcome = outcomes.at(worst[i]);
    text += std::to_string(i + 1) + ". run " + std::to_string(worst[i].run + 1) +
            (outcome.fault.empty() ? "" : ", " + outcome.fault);
    for (const Goal& goal : study.goals) {
      const double value = outcome.values.at(goal.quantity);
      if (value <= goal.max) continue;
      text += ", " + std::string(quantity(goal.quantity).name) + " " + shown(goal, value);
    }
    text += "\n";
  }
  if (text.empty()) return text;
  return "\nThe worst with " + name + " (worst-" + name +
         "-1.toml and following run them again):\n\n" + text;
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
  std::string text = "# " + study.name + "\n\nShares with their exact 95 % interval.\n\n" +
                     cells({"controller", "runs", "refused", "failed"}) + "|---|---|---|---|\n";
  for (const ContenderRow& row : table) {
    text += cells(
        {row.name, std::to_string(row.refused.runs), percent(row.refused), percent(row.failures)});
  }
  text += "\n" +
          cells({"controller", "quantity", "goal", "missed", "median", "95 of 100", "worst",
                 "goes with (rank correlation)"}) +
          "|---|---|---|---|---|---|---|---|\n";
  for (const ContenderRow& row : table) {
    for (const GoalRow& goal : row.goals) {
      text += cells({row.name, std::string(quantity(goal.goal.quantity).name),
                     "≤ " + shown(goal.goal, goal.goal.max), percent(goal.failures),
                     shown(goal.goal, goal.median), shown(goal.goal, goal.of_95_in_100),
                     shown(goal.goal, goal.worst), deciding(study, goal)});
    }
  }
  std::string told;
  for (const ContenderRow& row : table) {
    if (row.reason.empty() || row.reason == told) continue;
    told = row.reason;
    text += "\nRefused, the first: " + row.reason + "\n";
  }
  for (std::size_t i = 0; i < table.size(); ++i)
    text += worst_runs(study, outcomes, i);
  return text;
}

std::string to_markdown(const Study& study, const std::map<std::size_t, Worst>& found) {
  std::string text = "# The worst of " + study.name + "\n\n" +
                     cells({"controller", "runs", "quantity", "goal", "the worst found"}) +
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
  text += "\nsearch-CONTROLLER.toml runs it again.\n";
  return text;
}

}  // namespace supercoil::host_sim::campaign
