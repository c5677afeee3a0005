#include "report/run_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace supercoil::host_sim {

namespace {

constexpr std::int64_t points = 2000;
constexpr double mm = 1e3;
constexpr double um = 1e6;

/// Only while there is a reference model to follow.
double followed(const TickRecord& record, double value) {
  return record.open_loop ? NAN : value;
}

}  // namespace

RunPlot::RunPlot(const Scenario& scenario)
    : scenario_(&scenario), every_(std::max<std::int64_t>(1, scenario.ticks() / points)) {}

void RunPlot::add(const TickRecord& record, const std::optional<control::Estimate>& estimate) {
  records_.push_back(record);
  if (estimate) theta_.push_back(estimate->theta);
}

Figure RunPlot::figure() const {
  const auto curve = [&](const char* label, int colour, auto value) {
    Curve result{label, {}, {}, false, colour};
    for (const TickRecord& record : records_) {
      result.x.push_back(record.time_s);
      result.y.push_back(value(record));
    }
    return result;
  };
  Figure figure;
  Panel position{scenario_->name + ": position", "", "mm", {}};
  bool open_loop = true;
  for (const TickRecord& record : records_)
    open_loop = open_loop && record.open_loop;
  if (!open_loop) {
    position.curves.push_back(
        curve("reference", 6, [](const TickRecord& r) { return followed(r, r.reference * mm); }));
    position.curves.back().dashed = true;
    position.curves.push_back(curve(
        "reference model", 1, [](const TickRecord& r) { return followed(r, r.model_m * mm); }));
  }
  position.curves.push_back(
      curve("position", 0, [](const TickRecord& r) { return r.position_m * mm; }));
  figure.panels.push_back(position);
  if (!open_loop) {
    figure.panels.push_back({"error against the reference model",
                             "",
                             "µm",
                             {curve("position − model", 0, [](const TickRecord& r) {
                               return followed(r, (r.position_m - r.model_m) * um);
                             })}});
  }
  figure.panels.push_back({"power", "", "W", {curve("applied power", 1, [](const TickRecord& r) {
                             return r.applied_power_W;
                           })}});
  figure.panels.push_back(
      {"temperature above the air, and the firmware's bounds",
       "",
       "K",
       {curve("at most", 3, [](const TickRecord& r) { return r.hottest_K; }),
        curve("muscle", 2, [](const TickRecord& r) { return r.temperature_rise_K; }),
        curve("at least", 0, [](const TickRecord& r) { return r.coldest_K; })}});
  Panel state{"state",
              "",
              "",
              {curve("state", 1, [](const TickRecord& r) { return static_cast<double>(r.state); })},
              -0.2,
              3.2};
  state.y_names.assign(state_names.begin(), state_names.end());
  figure.panels.push_back(state);
  if (!theta_.empty()) {
    Panel estimates{"estimates over the muscle's own at the start", "", "ratio", {}, -0.5, 2.5};
    const control::Theta& nominal = scenario_->start.estimator.gradient.scale.nominal;
    for (int i = 0; i < 4; ++i) {
      std::size_t at = 0;
      estimates.curves.push_back(
          curve(("θ" + std::to_string(i + 1)).c_str(), i, [&](const TickRecord&) {
            const std::size_t index = std::min(at++, theta_.size() - 1);
            return theta_[index][i] / nominal[i];
          }));
    }
    figure.panels.push_back(estimates);
  }
  // All panels share one time axis, also those without values at the start or the end.
  for (Panel& panel : figure.panels)
    panel.x_high = scenario_->duration_s;
  figure.panels.back().x_label = "time (s)";
  return figure;
}

}  // namespace supercoil::host_sim
