#include "compare/plot.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::host_sim::compare {

namespace {

constexpr double plotted_um_per_m = 1e6;
/// Share of the distance between two disturbances that the points of all contenders take.
constexpr double spread = 0.7;

std::size_t place_of(std::vector<std::string>& names, const std::string& name) {
  const auto entry = std::find(names.begin(), names.end(), name);
  if (entry != names.end()) return static_cast<std::size_t>(entry - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

Panel panel_of(const std::vector<TableRow>& table, const std::vector<std::string>& contenders,
               std::size_t measure) {
  const bool time = measures[measure].kind == MeasureKind::settling;
  Panel panel;
  panel.title = std::string(measures[measure].name) + ": " + std::string(measures[measure].meaning);
  panel.x_label = "";
  panel.y_label = time ? "s" : "µm";
  const double unit = time ? 1.0 : plotted_um_per_m;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    Curve curve{contenders[i], {}, {}, false, static_cast<int>(i), {}};
    const double beside =
        spread * ((static_cast<double>(i) + 0.5) / static_cast<double>(contenders.size()) - 0.5);
    for (const TableRow& row : table) {
      const auto& s = row.statistics[measure];
      if (!s || row.contender() != contenders[i]) continue;
      const auto at = static_cast<double>(place_of(panel.x_names, row.disturbance));
      const bool drawn = std::isfinite(s->mean) && s->mean > 0.0;
      curve.x.push_back(at + beside);
      curve.y.push_back(drawn ? s->mean * unit : NAN);
      curve.bars_to.push_back(s->worst * unit);
    }
    if (!curve.x.empty()) panel.curves.push_back(curve);
  }
  return panel;
}

}  // namespace

Figure figure_of(const std::vector<TableRow>& table) {
  std::vector<std::string> contenders;
  for (const TableRow& row : table)
    place_of(contenders, row.contender());
  Figure figure;
  figure.width_px = 1100;
  figure.panel_height_px = 360;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    Panel panel = panel_of(table, contenders, i);
    if (!panel.curves.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace supercoil::host_sim::compare
