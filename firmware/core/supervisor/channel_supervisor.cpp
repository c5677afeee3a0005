#include "supervisor/channel_supervisor.hpp"

#include <cmath>

namespace supercoil {

namespace {

/// A muscle at a quarter of its cold conductance is as good as broken.
constexpr double open_load_ratio = 0.25;
/// Frozen: a live sensor's readings spread over more than this fraction of its noise.
constexpr double frozen_noise_ratio = 0.5;
/// Jump: two readings of a resting muscle differ by less than this many times the noise.
constexpr double jump_noises = 12.0;
/// Loose: a muscle is judged once its expected motion reaches this multiple of responding_min_m.
constexpr double loose_motions = 3.0;
/// The resistance is smoothed: outside its range for this long, it is not noise.
constexpr double drifting_s = 0.5;
constexpr double quiet_sensor_m = 50e-6;  ///< a jump exceeds this, however quiet the sensor

double frozen_band_m(const ChannelSupervision& s) {
  return s.position_noise_rms_m > 0.0 ? frozen_noise_ratio * s.position_noise_rms_m : -1.0;
}

/// A demand below zero is how a muscle cools; a demand above the applied power cannot last.
bool wants_more(const AxisInputs& axis, const HeaterInputs& heater) {
  return heater.limited && axis.demanded_W > heater.applied_W;
}

}  // namespace

ChannelSupervisor::ChannelSupervisor(const ChannelSupervision& s, double cold_resistance_Ohm,
                                     double min_supply_V, double sense_filter_s, double step_s)
    : settings_(s),
      out_of_range_({s.min_position_m, s.max_position_m, s.out_of_range_s}, step_s),
      frozen_({frozen_band_m(s), s.frozen_s}, step_s),
      jump_({s.max_speed_m_per_s, quiet_sensor_m + jump_noises * s.position_noise_rms_m}),
      disagree_({s.disagree_K, s.disagree_s}, step_s),
      open_({s.open_min_duty, open_load_ratio * min_supply_V / cold_resistance_Ohm, s.open_s},
            step_s),
      short_({s.off_current_A, s.short_s}, step_s),
      stuck_on_({s.off_current_A, s.stuck_on_s, sense_filter_s}, step_s),
      not_responding_({s.responding_window_s, s.responding_ratio, s.responding_min_m}, step_s),
      loose_({s.responding_ratio, loose_motions * s.responding_min_m}, step_s),
      wrong_duty_(s.wrong_duty_s, step_s),
      temperature_(s.trip_C),
      travel_(s.max_travel_m),
      energy_({s.energy_J, s.energy_window_s}, step_s),
      drift_({s.resistance_ratio, drifting_s}, step_s),
      power_({s.max_measured_W, s.over_power_s}, step_s),
      expired_(s.command_timeout_s, step_s),
      damaged_(s.damaged_in_a_row),
      refused_(s.refused_in_a_row),
      lost_(s.saturated_s, step_s) {}

Fault ChannelSupervisor::step(const AxisInputs& axis, const HeaterInputs& heater,
                              const CommandInputs& commands) {
  verdict_.begin();
  judge_sensors(axis, heater);
  judge_heater(heater);
  judge_answer(axis, heater);
  judge_muscle(axis, heater);
  judge_commands(commands, axis, heater);
  return verdict_.fault();
}

void ChannelSupervisor::judge_sensors(const AxisInputs& axis, const HeaterInputs& heater) {
  using enum Fault;
  const bool absent = !axis.position.present || !heater.current.present;
  verdict_.note(sensor_stale, stale_.step(absent), stale_);
  if (!axis.position.present) return;  // nothing to judge, and stale already says so
  verdict_.note(sensor_out_of_range, out_of_range_.step(axis.sensor_m), out_of_range_);
  // A reading outside the range is not a position: an intermittent one would look like a jump.
  // Judged before calibration, as a new calibration moves every position.
  if (axis.position_elapsed_s > 0.0 && inside(axis.sensor_m)) {
    verdict_.note(sensor_jump, jump_.step(axis.sensor_m, axis.position_elapsed_s), jump_);
  }
  verdict_.note(sensor_frozen, frozen_.step(axis.sensor_m, heater.hot), frozen_);
  verdict_.note(sensors_disagree, disagree_.step(heater.from_resistance_K, axis.from_position_K),
                disagree_);
}

void ChannelSupervisor::judge_heater(const HeaterInputs& e) {
  using enum Fault;
  const double current_A = e.current.present ? e.current.value : 0.0;
  verdict_.note(duty_wrong, wrong_duty_.step(e.set_step, e.devices_ok ? e.read_back : 1 << 30),
                wrong_duty_);
  // Without a reading nothing proves that the heat is off, so the board is cut to be safe.
  verdict_.note(heater_stuck_on, stuck_on_.step(e.off, e.current.present ? current_A : INFINITY),
                stuck_on_);
  if (!e.current.present) return;
  verdict_.note(heater_open, open_.step(e.off ? 0.0 : e.duty, current_A), open_);
  // Judges the excess over the current at the muscle's minimum resistance. Not judged while the
  // supply is unknown: under_voltage reports that.
  const double max_A = e.duty * e.supply_V / settings_.min_resistance_Ohm;
  const bool judged = !e.off && e.supply_V > 0.0;
  verdict_.note(heater_short, short_.step(judged ? current_A - max_A : 0.0), short_);
  const double measured_W = e.supply_V * current_A;
  verdict_.note(power_limit_exceeded, power_.step(measured_W), power_);
}

void ChannelSupervisor::judge_answer(const AxisInputs& axis, const HeaterInputs& heater) {
  using enum Fault;
  if (axis.recalibrated) not_responding_.recalibrate(*axis.recalibrated);
  if (axis.expected_jumped) not_responding_.reset();
  if (axis.recalibrated || axis.expected_jumped) loose_.reset();
  if (axis.answered) not_responding_.restart_range();
  if (!heater.current.present) return;
  if (axis.position.present) {
    const auto motions = detectors::NotResponding::possible(
        heater.expected_m, axis.in_joint ? &axis.opposed_m : nullptr);
    verdict_.note(heater_not_responding, not_responding_.step(axis.position.value, motions),
                  not_responding_);
    if (axis.in_joint) {
      const bool limited = !heater.off && wants_more(axis, heater);
      verdict_.note(muscle_loose, loose_.step(limited, axis.position.value, motions), loose_);
    }
  }
  if (axis.unanswered) {
    verdict_.note(heater_not_responding, unanswered_.step(true, axis.answer), unanswered_);
  }
}

void ChannelSupervisor::judge_muscle(const AxisInputs& axis, const HeaterInputs& heater) {
  using enum Fault;
  verdict_.note(over_temperature, temperature_.step(heater.hottest_C), temperature_);
  if (axis.position.present && inside(axis.sensor_m)) {
    verdict_.note(over_travel, travel_.step(axis.position.value), travel_);
  }
  verdict_.note(energy_budget_exceeded, energy_.step(heater.measured_W), energy_);
  // Also while heating: a sense that reads too little current makes the power stage give more.
  if (heater.resistance_fresh) {
    verdict_.note(resistance_drift,
                  drift_.step(heater.resistance_Ohm, heater.min_Ohm, heater.max_Ohm, heater.probed),
                  drift_);
  } else {
    drift_.skip();
  }
  if (heater.probe_failed) verdict_.note(heater_open, true, open_);
}

void ChannelSupervisor::judge_commands(const CommandInputs& commands, const AxisInputs& axis,
                                       const HeaterInputs& heater) {
  using enum Fault;
  const bool unmet_demand = commands.heating && wants_more(axis, heater);
  verdict_.note(controller_invalid, lost_.step(axis.demanded_W, unmet_demand), lost_);
  verdict_.note(command_timeout, expired_.step(commands.renewed, commands.heating), expired_);
  // Only an obeyed command ends a row, as damaged and refused ones may alternate.
  if (commands.damaged || commands.obeyed) {
    verdict_.note(command_damaged, damaged_.step(commands.damaged), damaged_);
  }
  if (commands.refused || commands.obeyed) {
    verdict_.note(command_not_allowed, refused_.step(commands.refused), refused_);
  }
}

}  // namespace supercoil
