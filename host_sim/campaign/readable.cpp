#include "campaign/readable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "batch/kept_lines.hpp"

namespace supercoil::host_sim::campaign {

namespace {

std::string listed(const std::string& word, const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += ", ";
    if (&name == &names.front()) text.append(word).append(" ");
    text += name;
  }
  return text;
}

std::string described(const Draw& draw, const Distribution& d) {
  using Kind = Distribution::Kind;
  switch (d.kind) {
    case Kind::uniform:
      return "uniform, " + batch::number(d.first) + " to " + batch::number(d.second);
    case Kind::log_uniform:
      return "log-uniform, " + batch::number(d.first) + " to " + batch::number(d.second);
    case Kind::normal: {
      std::string text = "normal, " + batch::number(d.first) + " ± " + batch::number(d.second);
      if (std::isfinite(d.min)) text += ", at least " + batch::number(d.min);
      if (std::isfinite(d.max)) text += ", at most " + batch::number(d.max);
      return text;
    }
    case Kind::list: {
      std::string text = "one of";
      for (std::size_t i = 0; i < d.values; ++i)
        text += (i == 0 ? " " : ", ") + text_of(draw, static_cast<double>(i));
      return text;
    }
    case Kind::constant:
      break;
  }
  return batch::number(d.first);
}

}  // namespace

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

std::string missed(const Study& study, const Outcome& outcome) {
  std::string text = outcome.fault;
  for (const Goal& goal : study.goals) {
    const double value = outcome.values.at(goal.quantity);
    if (value <= goal.max) continue;
    text += (text.empty() ? "" : ", ") + std::string(quantity(goal.quantity).name) + " " +
            shown(goal, value);
  }
  return text;
}

std::string deciding(const Study& study, const GoalRow& row) {
  constexpr std::size_t max_listed = 3;
  std::string text;
  const auto order = deciding_draws(row);
  for (std::size_t i = 0; i < std::min(max_listed, order.size()); ++i) {
    text += (text.empty() ? "" : ", ") + study.draws[order[i]].name + " " +
            brief(row.rank_correlations[order[i]]);
  }
  return text.empty() ? "–" : text;
}

std::string described(const Draw& draw) {
  std::string text = described(draw, draw.distribution) + listed("times", draw.times) +
                     listed("divided by", draw.over);
  if (!draw.group.empty())
    text += "; group " + draw.group + ", correlation " + batch::number(draw.correlation);
  return text;
}

std::string shell_word(const std::string& text) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text)
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::vector<std::size_t> deciding_draws(const GoalRow& row) {
  std::vector<std::size_t> order;
  // By chance alone, less than 3 draws in 1000 reach this.
  const double min_correlation =
      3.0 / std::sqrt(static_cast<double>(std::max<std::int64_t>(1, row.failures.runs)));
  for (std::size_t i = 0; i < row.rank_correlations.size(); ++i) {
    if (std::abs(row.rank_correlations[i]) > min_correlation) order.push_back(i);
  }
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::abs(row.rank_correlations[a]) > std::abs(row.rank_correlations[b]);
  });
  return order;
}

}  // namespace supercoil::host_sim::campaign
