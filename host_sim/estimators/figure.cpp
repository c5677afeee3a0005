#include <cmath>

#include "estimators/results.hpp"

namespace supercoil::host_sim::estimators {

using control::Theta;

namespace {

constexpr std::size_t drawn_trial = 0;
/// Errors below this would only stretch the axis, %.
constexpr double min_percent = 1e-4;

using Squares = std::vector<Theta> Outcome::*;

/// rms over the seeds, in %.
Curve curve_of(const Outcomes& outcomes, std::size_t contender, Squares squares, int parameter) {
  Curve curve{std::string(contenders[contender].name), {}, {}, false, static_cast<int>(contender)};
  std::vector<double> sums(plotted_s().size(), 0.0);
  double seeds = 0.0;
  for (const auto& [key, outcome] : outcomes) {
    if (key.trial != drawn_trial || key.contender != contender) continue;
    ++seeds;
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] += (outcome.*squares)[i][parameter];
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    curve.x.push_back(plotted_s()[i]);
    curve.y.push_back(std::max(min_percent, 100.0 * std::sqrt(sums[i] / seeds)));
  }
  return curve;
}

Curve bound_curve(const std::vector<Theta>& bound, int parameter) {
  Curve curve{"bound", {}, {}, true, static_cast<int>(contender_count)};
  for (std::size_t i = 0; i < bound.size(); ++i) {
    const double percent = 100.0 * bound[i][parameter];
    constexpr double max_percent = 100.0;
    if (!(percent < max_percent)) continue;  // no information yet
    curve.x.push_back(plotted_s()[i]);
    curve.y.push_back(percent);
  }
  return curve;
}

}  // namespace

Figure figure_of(const Outcomes& outcomes, const AllBounds& bounds) {
  Figure figure;
  figure.columns = 2;
  figure.width_px = 1100;
  figure.panel_height_px = 300;
  for (int parameter = 0; parameter < 4; ++parameter) {
    for (const bool changed : {false, true}) {
      Panel panel;
      panel.title =
          "θ" + std::to_string(parameter + 1) + (changed ? ", after the change" : ", from rest");
      panel.y_label = "error (% rms)";
      panel.x_logarithmic = panel.y_logarithmic = true;
      for (std::size_t i = 0; i < contenders.size(); ++i) {
        panel.curves.push_back(curve_of(
            outcomes, i, changed ? &Outcome::squares_after_change : &Outcome::squares_from_rest,
            parameter));
      }
      if (const auto& bound = bounds[drawn_trial]) {
        panel.curves.push_back(
            bound_curve(changed ? bound->after_change : bound->from_rest, parameter));
      }
      figure.panels.push_back(std::move(panel));
    }
  }
  return figure;
}

}  // namespace supercoil::host_sim::estimators
