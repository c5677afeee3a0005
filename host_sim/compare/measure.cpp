#include "compare/measure.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::host_sim::compare {

namespace {

/// The first seconds belong to the start, not to the steady motion.
constexpr double started_s = 20.0;
constexpr double settled_again_s = 60.0;

/// 1.6 periods of a sine, two holds of steps: 40 s of the paper's.
double steady_s(const Reference& reference) {
  if (reference.kind == ReferenceKind::steps) return 2.0 * reference.hold_s;
  if (reference.kind == ReferenceKind::sine)
    return 10.0 / reference.terms.front().angular_frequency_rad_per_s;
  return 40.0;
}

}  // namespace

std::array<Window, measures.size()> windows_of(const Scenario& scenario) {
  const double end_s = scenario.duration_s;
  const bool changes = !scenario.events.empty();
  const double event_s = changes ? scenario.events.front().at_s : end_s;
  const auto at_start = [&](double from_s, double to_s) {
    return changes ? Window{0.0, 0.0} : Window{from_s, to_s};
  };
  std::array<Window, measures.size()> windows{{
      at_start(0.0, 3.0),
      at_start(3.0, 10.0),
      at_start(10.0, 20.0),
      {std::max(started_s, event_s - steady_s(scenario.start.reference)), event_s},
      {event_s, event_s + 10.0},
      {event_s, event_s + settled_again_s},
      {event_s, end_s},
      {event_s + settled_again_s, end_s},
  }};
  for (Window& window : windows)
    window.to_s = std::min(window.to_s, end_s);
  return windows;
}

Meters::Meters(const Scenario& scenario) : step_s_(scenario.step_s()) {
  const auto windows = windows_of(scenario);
  for (std::size_t i = 0; i < windows.size(); ++i)
    meters_[i].window = windows[i];
}

void Meters::add(const TickRecord& record) {
  const double error_m = record.position_m - record.model_m;
  for (Meter& meter : meters_) {
    if (record.time_s < meter.window.from_s || record.time_s >= meter.window.to_s) continue;
    meter.lost = meter.lost || record.open_loop || !std::isfinite(error_m);
    meter.errors.add(error_m);
    meter.end_s = record.time_s + step_s_;
    if (!(std::abs(error_m) < settled_m)) meter.outside_until_s = meter.end_s;
  }
}

double Meters::value(std::size_t measure) const {
  const Meter& meter = meters_[measure];
  if (meter.errors.count() == 0) return NAN;
  if (meter.lost) return INFINITY;
  switch (measures[measure].kind) {
    case MeasureKind::rms:
      return meter.errors.rms();
    case MeasureKind::max:
      return meter.errors.max();
    case MeasureKind::settling:
      break;
  }
  if (meter.outside_until_s == meter.end_s) return INFINITY;
  return std::max(0.0, meter.outside_until_s - meter.window.from_s);
}

Values Meters::values() const {
  Values values{};
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = value(i);
  return values;
}

}  // namespace supercoil::host_sim::compare
