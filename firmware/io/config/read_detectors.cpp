// The other thresholds: their defaults suit most muscles.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "config/read_channel.hpp"

namespace supercoil::config {

namespace {

/// How long a detector must see something: at a slow rate at least some ticks, or one wild reading
/// would be enough.
double at_least_ticks(double time_s, double ticks, double step_s) {
  return std::max(time_s, ticks * step_s);
}

class Thresholds {
 public:
  Thresholds(Section& section, double step_s) : section_(&section), step_s_(step_s) {}

  /// In ms in the file.
  void time(const char* key, double& time_s, double ticks, Range range_ms) {
    const double fallback_ms = 1e3 * at_least_ticks(time_s, ticks, step_s_);
    time_s = 1e-3 * section_->number(key, fallback_ms, range_ms);
  }
  void number(const char* key, double& value, Range range) {
    value = section_->number(key, value, range);
  }

 private:
  Section* section_;
  double step_s_;
};

/// Each bus is served at its own time between two ticks, and its thread may be a little late. A
/// tick may then see a current from before or after the duty that it is compared with.
bool current_may_lag_duty(const ChannelWiring& wiring) {
  return wiring.pwm.access.buffered() || wiring.current.access.buffered();
}

void read_heater_detectors(Section& section, Thresholds& read, const BoardContext& context,
                           const ChannelWiring& wiring, ChannelSettings& c) {
  ChannelSupervision& s = c.supervision;
  const double cold_Ohm = c.heater.cold_resistance_Ohm;
  read.number("open_min_duty", s.open_min_duty, {0.001, 0.5});
  read.time("open_ms", s.open_s, 3.0, {1.0, 1000.0});
  if (std::isfinite(cold_Ohm)) s.min_resistance_Ohm = default_least_resistance_Ohm(cold_Ohm);
  read.number("min_resistance_Ohm", s.min_resistance_Ohm, {0.01, 1e4});
  if (s.min_resistance_Ohm >= cold_Ohm) {
    section.wrong("min_resistance_Ohm", "must be less than heater.cold_resistance_Ohm");
  }
  read.time("short_ms", s.short_s, current_may_lag_duty(wiring) ? 2.0 : 1.0, {0.1, 100.0});
  // The path to the charge pump is promised to take 50 ms at most.
  read.time("stuck_on_ms", s.stuck_on_s, 2.0, {5.0, 50.0});
  const double full_A = context.board.supervision.min_supply_V / cold_Ohm;
  if (s.off_current_A > 0.5 * full_A) {
    std::ostringstream message;
    message << "current.off_A = " << s.off_current_A
            << " A is more than half of what a switch that is stuck on passes: " << full_A << " A";
    section.wrong("stuck_on_ms", message.str());
  }
  read.number("responding_window_s", s.responding_window_s, {1.0, 600.0});
  read.number("responding_ratio", s.responding_ratio, {0.01, 0.9});
  read.number("responding_min_m", s.responding_min_m, {1e-6, 1.0});
  const bool by_default = s.proof_of_response && !c.joint.has_other();
  s.proof_of_response = section.flag("proof_of_response", by_default);
  if (s.proof_of_response && c.joint.has_other()) {
    section.wrong("proof_of_response",
                  "is not available in a joint: the other muscle moves it as well; leave it out, "
                  "or set it to false");
  }
  // A buffered duty reads back its old value until the bus's thread has written the new one.
  const double lag_ticks = wiring.pwm.access.buffered() ? 5.0 : 2.0;
  read.time("wrong_duty_ms", s.wrong_duty_s, lag_ticks, {1.0, 1000.0});
  read.number("resistance_ratio", s.resistance_ratio, {0.01, 2.0});
  read.time("over_power_ms", s.over_power_s, 2.0, {1.0, 1000.0});
}

}  // namespace

void read_detectors(Section section, const BoardContext& context, const ChannelWiring& wiring,
                    ChannelSettings& c) {
  ChannelSupervision& s = c.supervision;
  Thresholds read(section, context.board.step_s());
  read.time("out_of_range_ms", s.out_of_range_s, 2.0, {1.0, 1000.0});
  read.number("frozen_s", s.frozen_s, {0.1, 600.0});
  read.number("max_speed_m_per_s", s.max_speed_m_per_s, {1e-3, 100.0});
  read.number("disagree_K", s.disagree_K, {1.0, 200.0});
  read.number("disagree_s", s.disagree_s, {0.1, 60.0});
  read_heater_detectors(section, read, context, wiring, c);
  read.number("saturated_s", s.saturated_s, {0.1, 3600.0});
  section.finish();
}

}  // namespace supercoil::config
