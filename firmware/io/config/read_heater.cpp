#include <sstream>

#include "board/applied_power.hpp"
#include "config/read_channel.hpp"

namespace supercoil::config {

namespace {

/// Only a probe's second half is measured: at least one tick.
constexpr double min_probe_ticks = 2.0;

void read_probe(Section& section, double step_s, const PwmAddress& pwm, HeaterSettings& h) {
  h.probe_duty = section.number("probe_duty", h.probe_duty, {1e-4, 0.02});
  if (h.probe_duty * pwm.steps < 1.0) {
    std::ostringstream message;
    message << "is less than one of the PWM's " << pwm.steps << " steps: a probe would be 0";
    section.wrong("probe_duty", message.str());
  }
  h.probe_s = 1e-3 * section.number("probe_ms", 1e3 * h.probe_s, {1.0, 50.0});
  if (h.probe_s < min_probe_ticks * step_s) {
    std::ostringstream message;
    message << "must be at least two ticks: " << 1e3 * min_probe_ticks * step_s << " ms";
    section.wrong("probe_ms", message.str());
  }
  h.probe_every_s = section.number("probe_every_s", h.probe_every_s, {0.5, 600.0});
}

void read_thermal_fuse(Section& section, ChannelLabel& label) {
  // No fuse is made for less than 60 °C, and nylon melts at 260 °C.
  constexpr Range range_C{60.0, 260.0};
  label.thermal_fuse_C = section.optional_number("thermal_fuse_C", {0.0, range_C.max});
  const double opens_at_C = label.thermal_fuse_C.value_or(0.0);
  if (opens_at_C > 0.0 && opens_at_C < range_C.min) {
    section.wrong("thermal_fuse_C", "must be 60 to 260, or 0 if there is no thermal fuse");
  }
}

}  // namespace

void read_heater(Section section, const BoardContext& context, const PwmAddress& pwm,
                 ChannelSettings& c, ChannelLabel& label) {
  HeaterSettings& h = c.heater;
  const double step_s = context.board.step_s();
  h.cold_resistance_Ohm = section.required_number("cold_resistance_Ohm", {0.1, 1e4});
  c.calibration.cold_resistance_Ohm = h.cold_resistance_Ohm;
  h.temperature_coefficient_per_K =
      section.number("temperature_coefficient_per_K", 0.0, {0.0, 0.02});
  h.resistance_filter_s =
      1e-3 * section.number("resistance_filter_ms", 1e3 * h.resistance_filter_s, {0.0, 10e3});
  read_probe(section, step_s, pwm, h);
  read_thermal_fuse(section, label);
  h.error_feedback = section.flag("error_feedback", h.error_feedback);
  h.pwm_steps = pwm.steps;
  const double max_ms = 1e3 * step_s * static_cast<double>(board::OutputDelay::max_ticks);
  // A PWM's bus thread sets a duty within the tick in which it was requested.
  const double default_ms = pwm.access.buffered() ? 1e3 * step_s : 0.0;
  h.delay_s = 1e-3 * section.number("delay_ms", default_ms, {0.0, max_ms});
  section.finish();
}

}  // namespace supercoil::config
