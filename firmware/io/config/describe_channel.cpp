#include <cmath>
#include <ctime>
#include <iomanip>
#include <sstream>

#include "config/describe.hpp"

namespace supercoil::config {

namespace {

double mm(double metres) {
  return std::nearbyint(1e6 * metres) / 1e3;
}

void describe_wiring(std::ostream& out, const ChannelWiring& w, const ChannelSettings& c) {
  out << "  enable      " << shown(w.enable) << "\n"
      << "  PWM         output " << w.pwm.number << " of " << w.pwm.device << ", " << w.pwm.steps
      << " steps per period of " << 1e-6 * static_cast<double>(w.pwm.period_ns) << " ms, "
      << (w.pwm.access.buffered() ? "buffered on " + w.pwm.access.bus : std::string("direct"));
  if (c.heater.delay_s > 0.0) out << ", acts after " << 1e3 * c.heater.delay_s << " ms";
  out << "\n  position    " << shown(w.position) << "; "
      << 1e6 * std::abs(c.position.scaling.per_count) << " um per count, noise "
      << 1e6 * c.supervision.position_noise_rms_m << " um rms\n"
      << "              reads " << mm(c.supervision.min_position_m) << " to "
      << mm(c.supervision.max_position_m) << " mm; older than " << 1e3 * c.position.max_age_s
      << " ms is stale\n"
      << "  current     " << shown(w.current) << "; " << 1e3 * c.heater.current.scaling.per_count
      << " mA per count; up to " << 1e3 * c.supervision.off_current_A << " mA counts as zero\n";
}

void describe_bundle(std::ostream& out, const Bundle& bundle) {
  const bool parallel = bundle.parallel();
  out << "  bundle      " << bundle.muscles << " muscles, their threads in "
      << (parallel ? "parallel: when one breaks" : "series: when one is shorted")
      << " the resistance is " << std::nearbyint(100.0 * bundle.one_lost_ratio()) << " % "
      << (parallel ? "more" : "less") << ", and each of the others gets "
      << bundle.others_power_ratio() << " times its share\n";
}

void describe_limits(std::ostream& out, const ChannelSettings& c, const BoardSettings& board,
                     const ChannelLabel& label) {
  const ChannelSupervision& s = c.supervision;
  out << "  heater      " << c.heater.cold_resistance_Ohm << " Ohm when cold; probed with "
      << 100.0 * c.heater.probe_duty << " % duty for " << 1e3 * c.heater.probe_s << " ms\n";
  if (label.thermal_fuse_C.value_or(0.0) > 0.0) {
    out << "              its thermal fuse opens at " << *label.thermal_fuse_C << " °C\n";
  }
  if (label.bundle) describe_bundle(out, *label.bundle);
  out << "  power       " << c.limiter.min_W << " to " << c.limiter.max_W << " W; more than "
      << s.max_measured_W << " W measured is a fault, and more than " << s.energy_J << " J in "
      << s.energy_window_s << " s\n"
      << "  senses      " << describe_senses(c, board) << "\n"
      << "  motions     of a few um: " << describe_small_motions(c, board) << "\n"
      << "  travel      up to " << mm(s.max_travel_m) << " mm\n"
      << "  temperature " << (label.preset == Preset::skin ? "near skin: " : "")
      << "full power up to " << c.limiter.derate_from_C << " °C, none from " << s.trip_C
      << " °C on, where it trips\n";
  const control::ThermalBounds b = board::with_weighed_mass(c.thermal);
  const double rest_K =
      c.limiter.max_W * power_bounds(c, board).true_over_measured().max / b.min_transfer_W_per_K;
  out << "              from " << b.min_mass_J_per_K << " to " << b.max_mass_J_per_K << " J/K and "
      << b.min_transfer_W_per_K << " to " << b.max_transfer_W_per_K << " W/K; " << c.limiter.max_W
      << " W held indefinitely may heat it to " << std::nearbyint(c.thermal.air.warmest_C + rest_K)
      << " °C\n"
      << "              " << describe_heat(c) << "\n"
      << "              assumed to be at up to "
      << std::nearbyint(c.thermal.air.warmest_C + c.thermal.boot_rise_K) << " °C at boot\n";
}

/// The values that differ from the file, by name.
void describe_tuning(std::ostream& out, const board::StoredValues& tuned) {
  const char* before = "\n              stored by tune: ";
  for (std::size_t i = 0; i < tuned.values.size(); ++i) {
    if (!tuned.values[i]) continue;
    out << before << control::tunables()[i].name << " = " << *tuned.values[i];
    before = ", ";
  }
}

void describe_controllers(std::ostream& out, const ChannelSettings& c) {
  out << "  controllers ";
  for (std::size_t i = 0; i < c.controllers.size(); ++i) {
    const control::ControllerSettings& k = c.controllers[i];
    out << (i == 0 ? "" : "\n              ") << i << ": "
        << control::name_of(control::controller_names, k.kind);
    if (k.kind != control::ControllerKind::power) {
      out << " in " << control::name_of(control::arithmetic_names, k.arithmetic);
    }
    if (i < c.tuning.controllers.size()) describe_tuning(out, c.tuning.controllers[i]);
  }
  out << "\n";
}

void describe_estimators(std::ostream& out, const ChannelSettings& c) {
  out << "  estimators  ";
  for (std::size_t i = 0; i < c.estimators.size(); ++i) {
    const control::EstimatorSettings& e = c.estimators[i];
    out << (i == 0 ? "" : "\n              ") << i << ": "
        << control::name_of(control::estimator_names, e.kind);
    if (e.kind != control::EstimatorKind::none) {
      out << " in " << control::name_of(control::arithmetic_names, e.arithmetic);
    }
    if (i < c.tuning.estimators.size()) describe_tuning(out, c.tuning.estimators[i]);
  }
  out << "\n";
}

}  // namespace

std::string describe_heat(const ChannelSettings& c) {
  const board::ThermalSettings& t = c.thermal;
  std::ostringstream out;
  out.precision(3);
  if (t.weighed()) {
    out << "weighed to " << 100.0 * t.mass_error_ratio << " %";
  } else {
    out << "not weighed (thermal.weighed_mass_error_ratio)";
  }
  const board::KnownThermalBounds known = board::known_thermal_bounds(t, c.heat);
  if (known.count > 0) {
    const control::TransferSpan& span = known.spans[0];
    out << "; time constant " << c.heat.time_constant_s
        << " s: " << known.min_heat_transfer_W_per_K(span.from_K) << " to "
        << known.max_heat_transfer_W_per_K(span.to_K) << " W/K from " << span.from_K << " to "
        << span.to_K << " K above the air";
  } else if (t.weighed()) {
    out << "; identify finds the time constant, and with it the heat transfer";
  } else {
    out << ": position and power give the time constant only";
  }
  if (c.heat.has_reading()) {
    out << "; " << c.heat.steady_rise_K << " K above the air read at "
        << 0.5 * (c.heat.steady_min_W + c.heat.steady_max_W) << " W";
  } else {
    out << "; no thermometer was read (compare_rise)";
  }
  return out.str();
}

std::string describe_small_motions(const ChannelSettings& c, const BoardSettings& board) {
  if (c.joint.has_other()) return "not checked: the joint's other muscle moves it as well";
  if (c.bundle.follows()) return "checked for the bundle as a whole, by the channel that leads it";
  if (!c.supervision.proof_of_response) return "not checked: detectors.proof_of_response is false";
  const ProofPlan plan = plan_proof(proof_settings(c, board), c.muscle, board.rate_Hz);
  std::ostringstream out;
  if (c.response_ratio > 0.0) {
    out << std::nearbyint(1e2 * c.response_ratio)
        << " % arrive at the sensor, as identify measured";
    if (c.response_ratio < detectors::Response::min_response_ratio)
      out << ": friction takes the rest";
  } else {
    out << "not measured: run identify";
  }
  out << "; " << (c.muscle_identified ? "" : "once identified, ") << "up to "
      << std::nearbyint(1e2 * plan.provable_W) / 1e2 << " W, a lost contact is found in time";
  return out.str();
}

std::string describe_senses(const ChannelSettings& c, const BoardSettings& board) {
  const auto [min_ratio, max_ratio] = power_bounds(c, board).true_over_measured();
  std::ostringstream out;
  out.precision(3);
  if (c.senses.compared()) {
    const auto when = static_cast<std::time_t>(c.senses.compared_s);
    std::tm utc{};
    gmtime_r(&when, &utc);
    out << "compared with a meter on " << std::put_time(&utc, "%F") << ", ";
  } else {
    out << "until they are compared with a meter (supercoil doctor --compare-senses), ";
  }
  out << "the true power is " << min_ratio << " to " << max_ratio << " times the measured power";
  return out.str();
}

std::string describe_channel(const BoardConfig& config, std::size_t index) {
  std::ostringstream out;
  const ChannelSettings& c = config.settings.channels[index];
  const ChannelLabel& label = config.labels[index];
  const std::string title = "channel " + std::to_string(index + 1);
  out << title << (label.name == title ? "" : ": " + label.name) << "\n";
  describe_wiring(out, config.wiring.channels[index], c);
  describe_limits(out, c, config.settings, label);
  if (c.joint.turns() && !c.joint.has_other())
    out << "  joint       " << describe_turned(config, index) << "\n";
  if (c.joint.weighs()) out << "              " << describe_weight(c) << "\n";
  if (is_led(c)) {
    const double offset =
        c.bundle.follows() ? c.bundle.leader_offset : c.joint.other_channel_offset;
    const double leader = static_cast<double>(index + 1) + offset;
    out << "  controllers led by channel " << leader << ": its own are not used\n";
  } else {
    describe_controllers(out, c);
  }
  describe_estimators(out, c);
  const char* title_of_line = "  can do      ";
  for (const std::string& line : describe_feasibility(config.settings, index)) {
    out << title_of_line << line << "\n";
    title_of_line = "              ";
  }
  title_of_line = "  recommended ";
  for (const std::string& line : describe_recommendation(config.settings, index)) {
    out << title_of_line << line << "\n";
    title_of_line = "              ";
  }
  return out.str();
}

}  // namespace supercoil::config
