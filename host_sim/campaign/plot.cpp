#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "campaign/tables.hpp"

namespace supercoil::host_sim::campaign {

namespace {

/// More points would only make the file larger.
constexpr std::size_t max_points = 250;

struct Point {
  std::size_t run;
  double value;
};

std::vector<Point> finite_values(const Outcomes& outcomes, std::size_t contender,
                                 std::size_t quantity) {
  std::vector<Point> points;
  for (const auto& [key, outcome] : outcomes) {
    const double value = outcome.values.at(quantity);
    if (key.contender == contender && outcome.refused.empty() && std::isfinite(value))
      points.push_back({key.run, value});
  }
  return points;
}

/// Errors range over decades, in micrometres.
struct Axis {
  std::string label;
  double scale = 1.0;
  bool logarithmic = false;
};
Axis axis_of(std::size_t number) {
  const std::string name(quantity(number).name);
  constexpr double um_per_m = 1e6;
  if (name.ends_with("_m")) return {name.substr(0, name.size() - 2) + " (µm)", um_per_m, true};
  return {name};
}

/// For a list, whose indices are drawn, the label gives the values.
std::string label_of(const Draw& draw) {
  std::string label = draw.name;
  for (std::size_t i = 0; i < draw.distribution.values; ++i) {
    const std::string value = text_of(draw, static_cast<double>(i));
    label += (i == 0 ? ": " : ", ") + std::to_string(i) + " is " + value;
  }
  return label;
}

std::string label_of(const Study& study, std::size_t contender) {
  return study.contenders[contender].name;
}

/// Share of all runs at or below a value; a run without a finite value never is.
Panel distribution(const Study& study, const std::vector<ContenderRow>& table,
                   const Outcomes& outcomes, std::size_t goal) {
  const Goal& of = study.goals[goal];
  Panel panel;
  const Axis axis = axis_of(of.quantity);
  panel.title = axis.label + ": runs at or below";
  panel.x_label = axis.label;
  panel.y_label = "%";
  panel.y_low = 0.0;
  panel.y_high = 100.0;
  double max_value = axis.scale * of.max;
  double min_value = max_value;
  for (std::size_t i = 0; i < table.size(); ++i) {
    std::vector<Point> points = finite_values(outcomes, i, of.quantity);
    std::ranges::sort(points, {}, &Point::value);
    const auto runs = static_cast<double>(table[i].failures.runs);
    Curve curve{label_of(study, i), {}, {}, false, static_cast<int>(i), {}};
    const std::size_t every = points.size() / max_points + 1;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k % every != 0 && k + 1 != points.size()) continue;
      curve.x.push_back(axis.scale * points[k].value);
      curve.y.push_back(100.0 * static_cast<double>(k + 1) / runs);
    }
    // A few outliers would squeeze all other runs into a corner.
    if (!points.empty()) {
      max_value = std::max(max_value, axis.scale * points[points.size() * 98 / 100].value);
      min_value = std::min(min_value, axis.scale * points.front().value);
      panel.curves.push_back(std::move(curve));
    }
  }
  panel.curves.push_back({"goal",
                          {axis.scale * of.max, axis.scale * of.max},
                          {0.0, 100.0},
                          true,
                          static_cast<int>(table.size()),
                          {}});
  panel.x_logarithmic = axis.logarithmic && min_value > 0.0;
  panel.x_low = panel.x_logarithmic ? 0.95 * min_value : std::min(0.0, min_value);
  panel.x_high = 1.05 * max_value;
  return panel;
}

/// The draw that the goal's quantity follows most, with any contender; empty if it follows none.
std::optional<std::size_t> deciding(const std::vector<ContenderRow>& table, std::size_t goal) {
  std::optional<std::size_t> draw;
  double max_abs = -1.0;
  for (const ContenderRow& row : table) {
    const auto& rank_correlations = row.goals[goal].rank_correlations;
    for (std::size_t i = 0; i < rank_correlations.size(); ++i) {
      if (!(std::abs(rank_correlations[i]) > max_abs)) continue;
      max_abs = std::abs(rank_correlations[i]);
      draw = i;
    }
  }
  return draw;
}

Panel scatter(const Study& study, const Draws& draws, const std::vector<ContenderRow>& table,
              const Outcomes& outcomes, std::size_t goal, std::size_t draw) {
  const std::size_t number = study.goals[goal].quantity;
  Panel panel;
  panel.title = "strongest correlation: " + study.draws[draw].name;
  panel.x_label = label_of(study.draws[draw]);
  const Axis axis = axis_of(number);
  panel.y_label = axis.label;
  panel.x_logarithmic = study.draws[draw].distribution.kind == Distribution::Kind::log_uniform;
  bool above_0 = true;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::vector<Point> points = finite_values(outcomes, i, number);
    Curve curve{label_of(study, i), {}, {}, false, static_cast<int>(i), {}, true};
    // The first points are spread as evenly as all; every n-th point may not be.
    for (std::size_t k = 0; k < std::min(points.size(), max_points); ++k) {
      curve.x.push_back(draws.of_run(points[k].run)[draw]);
      curve.y.push_back(axis.scale * points[k].value);
    }
    above_0 = above_0 && std::ranges::all_of(curve.y, [](double y) { return y > 0.0; });
    if (!points.empty()) panel.curves.push_back(std::move(curve));
  }
  panel.y_logarithmic = axis.logarithmic && above_0;
  return panel;
}

bool varies(const std::vector<ContenderRow>& table, std::size_t goal) {
  return std::ranges::any_of(table, [&](const ContenderRow& row) {
    return row.goals[goal].worst > row.goals[goal].median;
  });
}

}  // namespace

Figure figure_of(const Study& study, const Draws& draws, const Outcomes& outcomes,
                 const std::vector<ContenderRow>& table) {
  Figure figure;
  figure.columns = 2;
  figure.width_px = 1200;
  figure.panel_height_px = 320;
  for (std::size_t goal = 0; goal < study.goals.size(); ++goal) {
    if (!varies(table, goal)) continue;
    figure.panels.push_back(distribution(study, table, outcomes, goal));
    if (const auto draw = deciding(table, goal))
      figure.panels.push_back(scatter(study, draws, table, outcomes, goal, *draw));
  }
  return figure;
}

}  // namespace supercoil::host_sim::campaign
