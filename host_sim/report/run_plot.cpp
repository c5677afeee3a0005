#include "report/run_plot.hpp"

#include <algorithm>

namespace supercoil::host_sim {

namespace {

constexpr long points = 2000;
constexpr double mm = 1e3;
constexpr double um = 1e6;

}  // namespace

RunPlot::RunPlot(const Scenario& scenario)
    : scenario_(&scenario), every_(std::max(1L, scenario.ticks() / points)) {}

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
  const bool open_loop = !records_.empty() && records_.front().open_loop;
  if (!open_loop) {
    position.curves.push_back(
        curve("reference", 6, [](const TickRecord& r) { return r.reference * mm; }));
    position.curves.back().dashed = true;
    position.curves.push_back(
        curve("reference model", 1, [](const TickRecord& r) { return r.model_m * mm; }));
  }
  position.curves.push_back(
      curve("position", 0, [](const TickRecord& r) { return r.position_m * mm; }));
  figure.panels.push_back(position);
  if (!open_loop) {
    figure.panels.push_back({"error against the reference model",
                             "",
                             "µm",
                             {curve("position − model", 0, [](const TickRecord& r) {
                               return (r.position_m - r.model_m) * um;
                             })}});
  }
  figure.panels.push_back(
      {"power and temperature",
       "",
       "W, K",
       {curve("applied power (W)", 1, [](const TickRecord& r) { return r.applied_power_W; }),
        curve("temperature rise (K)", 2,
              [](const TickRecord& r) { return r.temperature_rise_K; })}});
  if (!theta_.empty()) {
    Panel estimates{"estimates over the muscle's own at the start", "", "1", {}, -0.5, 2.5};
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
  figure.panels.back().x_label = "time (s)";
  return figure;
}

}  // namespace supercoil::host_sim
