#include <algorithm>
#include <cmath>
#include <cstdio>

#include "compare/table.hpp"

namespace supercoil::host_sim::compare {

namespace {

constexpr double um_per_m = 1e6;

std::vector<std::string> distinct(const std::vector<TableRow>& table,
                                  std::string (*name)(const TableRow&)) {
  std::vector<std::string> names;
  for (const TableRow& row : table) {
    if (std::find(names.begin(), names.end(), name(row)) == names.end()) names.push_back(name(row));
  }
  return names;
}

/// Two decimals below 9.95, one below 99.5, otherwise none.
std::string shown(double value) {
  if (std::isinf(value)) return "∞";
  std::array<char, 32> text{};
  const int digits = value < 9.95 ? 2 : value < 99.5 ? 1 : 0;
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::string cell(const TableRow& row, std::size_t measure) {
  const auto& statistics = row.statistics[measure];
  if (!statistics) return "";
  const double unit = measures[measure].kind == MeasureKind::settling ? 1.0 : um_per_m;
  std::string text = shown(statistics->mean * unit);
  if (std::isfinite(statistics->half_width)) text += " ± " + shown(statistics->half_width * unit);
  text += " (" + shown(statistics->worst * unit) + ")";
  const auto goal = goal_of(row, measures[measure].name);
  if (!goal) return text;
  return text + (statistics->worst <= *goal ? " ≤ " : " **> ") + shown(*goal * unit) +
         (statistics->worst <= *goal ? "" : "**");
}

bool has(const TableRow& row, std::size_t measure) {
  return row.statistics[measure].has_value();
}

}  // namespace

std::string to_markdown(const std::vector<TableRow>& table) {
  const auto contenders = distinct(table, [](const TableRow& row) { return row.contender(); });
  std::string text =
      "Mean over the seeds ± half of its 95 % confidence interval (worst seed) ≤ goal, which the "
      "worst seed must keep; ∞: no longer followed, or never settled.\n";
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const bool none =
        std::none_of(table.begin(), table.end(), [&](const TableRow& row) { return has(row, i); });
    if (none) continue;
    const bool time = measures[i].kind == MeasureKind::settling;
    text += "\n### `" + std::string(measures[i].name) + "`\n\n" + std::string(time ? "s" : "µm") +
            ": " + std::string(measures[i].meaning) + ".\n\n| |";
    for (const std::string& contender : contenders)
      text += " `" + contender + "` |";
    text += "\n|---|";
    for (std::size_t k = 0; k < contenders.size(); ++k)
      text += "---|";
    text += "\n";
    for (const std::string& disturbance :
         distinct(table, [](const TableRow& row) { return row.disturbance; })) {
      std::string line = "| `" + disturbance + "` |";
      bool any = false;
      for (const std::string& contender : contenders) {
        const auto row = std::find_if(table.begin(), table.end(), [&](const TableRow& candidate) {
          return candidate.disturbance == disturbance && candidate.contender() == contender;
        });
        any = any || (row != table.end() && has(*row, i));
        line += " " + (row == table.end() ? "" : cell(*row, i)) + " |";
      }
      if (any) text += line + "\n";
    }
  }
  return text;
}

}  // namespace supercoil::host_sim::compare
