// Which detectors a configuration leaves blind: better read before the muscle is heated than after.
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "config/describe.hpp"
#include "config/findings.hpp"

namespace supercoil::config {

namespace {

/// With fewer counts of current, a probe says little.
constexpr double min_probe_counts = 10.0;
/// Ratings come in steps of up to 25 K, and the smallest is for 72 °C: near skin there is no other
/// choice.
constexpr double max_fuse_above_trip_K = 30.0;

void judge_sensors(const ChannelSettings& c, Findings& findings) {
  if (c.supervision.position_noise_rms_m == 0.0) {
    findings.add(Fault::sensor_frozen,
                 "position.noise_rms_m is 0, and a frozen sensor looks like a quiet one");
  } else if (c.supervision.position_noise_rms_m < 0.3 * std::abs(c.position.scaling.per_count)) {
    findings.add(Fault::sensor_frozen,
                 "one count is more than the noise: a resting sensor may look frozen, and trip");
  }
  if (c.heater.temperature_coefficient_per_K == 0.0) {
    findings.add(Fault::sensors_disagree,
                 "heater.temperature_coefficient_per_K is 0: the resistance gives no temperature");
  }
}

void judge_heater(const ChannelSettings& c, const BoardSettings& board, Findings& findings) {
  const HeaterSettings& h = c.heater;
  const ChannelSupervision& s = c.supervision;
  const double probe_A = h.probe_duty * board.supervision.min_supply_V / h.cold_resistance_Ohm;
  if (probe_A < min_probe_counts * h.current.scaling.per_count) {
    std::ostringstream reason;
    reason << "a probe's " << 1e3 * probe_A << " mA is only "
           << probe_A / h.current.scaling.per_count << " counts: the resistance is barely resolved";
    findings.add(Fault::resistance_drift, reason.str());
  }
  // What run_self_test() counts as a current that flows.
  const double idle_A = 0.3 * probe_A;
  if (s.off_current_A > idle_A) {
    std::ostringstream reason;
    reason << "more than " << 1e3 * idle_A << " mA fails it, and current.off_A is "
           << 1e3 * s.off_current_A << " mA: the configured off current may be too large";
    findings.add(Fault::self_test_failed, reason.str());
  }
  const double max_motion_m = c.limiter.max_W * c.muscle.dc_gain_m_per_W();
  if (max_motion_m < s.responding_min_m) {
    findings.add(Fault::heater_not_responding,
                 "max_W moves the muscle less than detectors.responding_min_m: never checked");
  }
}

/// Only a dither shows whether a hot muscle at rest still responds.
void judge_proof(const ChannelSettings& c, const BoardSettings& board, Findings& findings) {
  if (!c.supervision.proof_of_response) {
    findings.add(Fault::heater_not_responding,
                 std::string(c.joint.has_other()  ? "proof of response is not available in a joint"
                             : c.bundle.follows() ? "only the bundle as a whole proves its response"
                                                  : "detectors.proof_of_response is false") +
                     ": a muscle that is held still, off its sensor and poorly cooled may exceed "
                     "its limit undetected");
    return;
  }
  const ProofPlan plan = plan_proof(proof_settings(c, board), c.muscle, board.rate_Hz);
  if (plan.provable_W >= c.limiter.max_W) return;
  std::ostringstream reason;
  const bool friction = c.response_ratio > 0.0 && c.response_ratio < 1.0;
  reason << (friction
                 ? "friction leaves too little of a small motion to stand out from noise in time: "
                 : "a motion of 20 um or two counts stands out from the sensor's noise too late "
                   "for more: once identified, ")
         << "the muscle gets no more than " << std::nearbyint(1e2 * plan.provable_W) / 1e2
         << " W (limited_by unproven)";
  findings.add(Fault::heater_not_responding, reason.str());
}

void judge_muscle(const ChannelSettings& c, Findings& findings) {
  const ChannelSupervision& s = c.supervision;
  if (s.energy_J >= c.limiter.max_W * s.energy_window_s) {
    findings.add(Fault::energy_budget_exceeded,
                 "max_W for the whole window is within energy_J: it trips only when more is "
                 "measured than was asked for");
  }
}

/// Only the thermal fuse senses a hot place of the thread, and only it cuts without a board.
void judge_thermal_fuse(const std::optional<double>& opens_at_C, double trip_C,
                        Findings& findings) {
  std::ostringstream reason;
  if (!opens_at_C) {
    reason << "heater.thermal_fuse_C is not given: state the temperature at which it opens";
  } else if (*opens_at_C == 0.0) {
    reason << "none: nothing detects hot spots and shorted turns";
  } else if (*opens_at_C < trip_C) {
    reason << "opens at " << *opens_at_C << " °C, below trip_C = " << trip_C
           << " °C: it may open, permanently, in normal use";
  } else if (*opens_at_C > trip_C + max_fuse_above_trip_K) {
    reason << "opens at " << *opens_at_C << " °C, more than " << max_fuse_above_trip_K
           << " K above trip_C = " << trip_C
           << " °C: an overheated muscle stays powered until then";
  } else {
    return;
  }
  findings.add("thermal fuse", reason.str());
}

/// Parallel threads of which one could break unseen are refused in read_bundle.cpp.
void judge_bundle(const Bundle& bundle, const ChannelSettings& c, Findings& findings) {
  if (bundle.parallel() || bundle.one_lost_ratio() > bundle.undetected_ratio(c)) return;
  std::ostringstream reason;
  reason << "one shorted muscle of " << bundle.muscles << " in series is "
         << std::nearbyint(100.0 * bundle.one_lost_ratio())
         << " % less resistance, which resistance_drift lets pass: the others get "
         << bundle.others_power_ratio()
         << " times their share undetected, except by their thermal fuses";
  findings.add(Fault::resistance_drift, reason.str());
}

}  // namespace

std::vector<std::string> warnings(const BoardConfig& config) {
  Findings findings;
  for (std::size_t i = 0; i < config.settings.channels.size(); ++i) {
    const ChannelSettings& c = config.settings.channels[i];
    findings.enter(i + 1);
    judge_sensors(c, findings);
    judge_heater(c, config.settings, findings);
    judge_proof(c, config.settings, findings);
    judge_muscle(c, findings);
    judge_thermal_fuse(config.labels[i].thermal_fuse_C, c.supervision.trip_C, findings);
    if (const auto& bundle = config.labels[i].bundle) judge_bundle(*bundle, c, findings);
  }
  std::vector<std::string> lines = findings.lines();
  lines.push_back(
      "board: " + std::string(name(Fault::duty_wrong)) +
      ": a duty read back from sysfs is only what the kernel stored; only current proves "
      "power");
  if (!config.wiring.watchdog) {
    lines.emplace_back("board: no watchdog: a hung kernel is cut by the charge pump alone");
  }
  return lines;
}

}  // namespace supercoil::config
