#include <cmath>
#include <cstdio>

#include "compare/statistics.hpp"
#include "estimators/measures.hpp"
#include "estimators/results.hpp"

namespace supercoil::host_sim::estimators {

using control::Theta;

namespace {

/// Three digits, and no exponent.
std::string shown(double value) {
  if (std::isinf(value)) return "∞";
  std::array<char, 32> text{};
  const double size = std::abs(value);
  const int digits = size >= 99.95 ? 0 : size >= 9.995 ? 1 : size >= 0.0995 ? 2 : 4;
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::vector<Outcome> of_cell(const Outcomes& outcomes, std::size_t trial, std::size_t contender) {
  std::vector<Outcome> cell;
  for (const auto& [key, outcome] : outcomes) {
    if (key.trial == trial && key.contender == contender) cell.push_back(outcome);
  }
  return cell;
}

std::string row(const std::string& trial, const std::string& name,
                const std::array<std::string, 4>& cells) {
  std::string line = "| " + trial + " | " + name + " |";
  for (const std::string& cell : cells)
    line += " " + cell + " |";
  return line + "\n";
}

std::string table_of(const Measure& measure, const Outcomes& outcomes, const AllBounds& bounds) {
  std::string text = "\n### `" + std::string(measure.name) + "`\n\n" +
                     std::string(measure.meaning) +
                     ".\n\n| trial | | θ1 | θ2 | θ3 | θ4 |\n|---|---|---|---|---|---|\n";
  for (std::size_t trial = 0; trial < trials.size(); ++trial) {
    std::string first = "`" + std::string(trials[trial].name) + "`";
    std::array<std::string, 4> cells;
    if (bounds[trial]) {
      for (int i = 0; i < 4; ++i) {
        cells[static_cast<std::size_t>(i)] =
            "*" + shown(((*bounds[trial]).*measure.bound)[i] * measure.shown_unit) + "*";
      }
      text += row(first, "*bound*", cells);
      first.clear();
    }
    for (std::size_t contender = 0; contender < contenders.size(); ++contender) {
      const auto cell = of_cell(outcomes, trial, contender);
      if (cell.empty()) continue;
      for (int i = 0; i < 4; ++i) {
        std::vector<double> values;
        values.reserve(cell.size());
        for (const Outcome& outcome : cell)
          values.push_back((outcome.*measure.value)[i] * measure.shown_unit);
        const compare::Statistics s = compare::statistics_of(values);
        cells[static_cast<std::size_t>(i)] = shown(s.mean) + " (" + shown(s.worst) + ")";
      }
      text += row(first, "`" + std::string(contenders[contender].name) + "`", cells);
      first.clear();
    }
  }
  return text;
}

/// Reported standard deviations over actual errors, all seeds together.
std::string honesty_table(const Outcomes& outcomes) {
  std::string text =
      "\n### Reported standard deviations over actual errors\n\nrms over the last 40 s before the "
      "change. Below 1: overconfident.\n\n"
      "| trial | | θ1 | θ2 | θ3 | θ4 |\n|---|---|---|---|---|---|\n";
  for (std::size_t trial = 0; trial < trials.size(); ++trial) {
    for (std::size_t contender = 0; contender < contenders.size(); ++contender) {
      Theta reported = Theta::Zero();
      Theta actual = Theta::Zero();
      for (const Outcome& outcome : of_cell(outcomes, trial, contender)) {
        reported += outcome.reported_rms.cwiseAbs2();
        actual += outcome.steady_rms.cwiseAbs2();
      }
      const Theta ratio = reported.cwiseQuotient(actual).cwiseSqrt();
      if (!ratio.allFinite()) continue;
      std::array<std::string, 4> cells;
      for (int i = 0; i < 4; ++i)
        cells[static_cast<std::size_t>(i)] = shown(ratio[i]);
      text += row("`" + std::string(trials[trial].name) + "`",
                  "`" + std::string(contenders[contender].name) + "`", cells);
    }
  }
  return text;
}

}  // namespace

std::string to_markdown(const Outcomes& outcomes, const AllBounds& bounds, const Costs& costs) {
  std::string text = "Mean over the seeds (worst seed); ∞: not by the end, in one seed at least.\n";
  for (const Measure& measure : measures)
    text += table_of(measure, outcomes, bounds);
  text += honesty_table(outcomes);
  text += "\n### Cost\n\n| | ns a step |\n|---|---|\n";
  for (std::size_t i = 0; i < contenders.size(); ++i)
    text += "| `" + std::string(contenders[i].name) + "` | " + shown(costs[i]) + " |\n";
  return text;
}

}  // namespace supercoil::host_sim::estimators
