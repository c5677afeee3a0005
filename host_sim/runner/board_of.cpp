#include "runner/board_of.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::host_sim {

namespace {

ConverterSettings converter_of(const PositionSensorSettings& s) {
  return {.low = s.min_m,
          .high = s.range_m,
          .bits = s.resolution_bits,
          .noise_rms = s.noise_rms_m,
          .period_s = s.rate_Hz > 0.0 ? 1.0 / s.rate_Hz : 0.0,
          .latency_s = 0.0,
          .count = s.count_m};
}

/// In counts: less noise than this does not show in every reading.
constexpr double shown_noise = 0.3;

/// Three ticks or two and a half conversions, and never less than a slow machine's hiccup.
double max_age_s(const Scenario& scenario, const ConverterSettings& converter) {
  return std::max({0.01, 3.0 * scenario.step_s(), 2.5 * converter.period_s});
}

/// The sensor as the antagonist sees it. lever_ratio: the antagonist's lever over the agonist's.
PositionSensorSettings mirrored(PositionSensorSettings sensor, double lever_ratio) {
  const double min_m = sensor.min_m;
  sensor.min_m = -lever_ratio * sensor.range_m;
  sensor.range_m = -lever_ratio * min_m;
  sensor.noise_rms_m *= lever_ratio;
  sensor.count_m *= lever_ratio;
  return sensor;
}

board::Scaling mirrored(const board::Scaling& scaling, double lever_ratio) {
  return {-lever_ratio * scaling.per_count, -lever_ratio * scaling.offset};
}

/// The muscle's effects in its air.
PlantEffects effects_of(const Scenario& scenario, const Conditions& c, const PlantSettings& plant) {
  PlantEffects effects = plant.effects;
  effects.air_C = scenario.start.ambient.air_C;
  effects.air_change_K = plant.air_acts ? c.ambient.air_C - effects.air_C : 0.0;
  return effects;
}

board::Scaling scaling_of(const ConverterSettings& c) {
  return {c.per_count(), c.low};
}

/// 12 ticks: more than twice the five overruns that are tolerated in a row.
double pump_decay_s(const Scenario& scenario) {
  if (scenario.board) return scenario.board->supervision.charge_pump_decay_s;
  return std::max(0.02, 12.0 * scenario.step_s());
}

double max_power_W(const Scenario& scenario) {
  double peak_W = scenario.start.power.max_W;
  for (const Event& event : scenario.events)
    peak_W = std::max(peak_W, event.conditions.power.max_W);
  return peak_W;
}

double max_noise_m(const Scenario& scenario) {
  double max_m = scenario.start.position_sensor.noise_rms_m;
  for (const Event& event : scenario.events)
    max_m = std::max(max_m, event.conditions.position_sensor.noise_rms_m);
  return max_m;
}

ChannelSupervision supervision_of(const Scenario& scenario, const PositionSensorSettings& sensor,
                                  double resistance_Ohm) {
  const double range_m = sensor.range_m;
  const double min_m = sensor.min_m;
  const double max_W = max_power_W(scenario);
  ChannelSupervision s;
  s.min_position_m = min_m - 0.1 * (range_m - min_m);
  s.max_position_m = 1.1 * range_m - 0.1 * min_m;
  s.max_travel_m = Conditions::travel_ratio * range_m;
  s.position_noise_rms_m = max_noise_m(scenario);
  // At rest, a sensor without noise, or with too little to show in its counts, looks frozen.
  const double count_m = converter_of(sensor).per_count();
  if (sensor.noise_rms_m < s.position_noise_rms_m || s.position_noise_rms_m < shown_noise * count_m)
    s.frozen_s = INFINITY;
  s.out_of_range_s = std::max(s.out_of_range_s, 2.0 * scenario.step_s());
  s.min_resistance_Ohm = default_least_resistance_Ohm(resistance_Ohm);
  s.max_measured_W = default_max_measured_W(max_W);
  s.energy_J = default_energy_J(max_W, s.energy_window_s);
  return s;
}

board::ThermalSettings thermal_of(const Conditions& c, const control::PhysicalParameters& m) {
  const ThermalSpans& spans = c.thermal;
  board::ThermalSettings t;
  t.bounds = {m.thermal_mass_J_per_K * spans.mass_ratio[0],
              m.thermal_mass_J_per_K * spans.mass_ratio[1],
              m.heat_transfer_W_per_K * spans.transfer_ratio[0],
              m.heat_transfer_W_per_K * spans.transfer_ratio[1]};
  t.min_power_ratio = spans.power_ratio[0];
  t.max_power_ratio = spans.power_ratio[1];
  t.thermal_mass_J_per_K = m.thermal_mass_J_per_K;
  t.air = {c.ambient.warmest_C, c.ambient.coldest_C, c.ambient.sensor_error_K};
  return t;
}

/// The user's own board over simulated converters, with their scaling.
BoardSettings over(BoardSettings board, const SimulatedBoardSettings& simulated) {
  board.supply.scaling = scaling_of(simulated.supply);
  if (simulated.air) board.air.scaling = scaling_of(*simulated.air);
  const board::Scaling position = scaling_of(simulated.channels[0].position);
  board.channels[0].position.scaling = position;
  for (const BundleSettings& bundle : board.bundles) {
    for (const std::size_t channel : bundle.channels)
      board.channels[channel].position.scaling = position;
  }
  // A joint's antagonist sees the same position mirrored.
  if (!board.joints.empty()) {
    board.channels[1].position.scaling = mirrored(position, board.joints[0].antagonist_lever_ratio);
  }
  for (std::size_t i = 0; i < board.channels.size(); ++i) {
    board.channels[i].heater.current.scaling = scaling_of(simulated.channels[i].current);
    board.channels[i].heater.pwm_steps = simulated.channels[i].pwm_steps;
  }
  return board;
}

/// In °C; ideal apart from its error.
const ConverterSettings air_sensor{.low = -100.0, .high = 200.0};

double whole_ticks_s(const Scenario& scenario, double time_s) {
  return std::nearbyint(time_s * scenario.rate_Hz) / scenario.rate_Hz;
}

MuscleChannelSettings channel_of(const Scenario& scenario, const Conditions& c,
                                 const PlantSettings& plant) {
  MuscleChannelSettings m;
  m.plant = plant.parameters;
  m.effects = effects_of(scenario, c, plant);
  m.rise_from_C = c.ambient.air_C - m.effects.air_change_K;
  if (c.thermometer.present) {
    m.thermometer = {c.thermometer.lag_s, c.thermometer.offset_K, c.thermometer.noise_rms_K,
                     1.0 / c.thermometer.rate_Hz};
  }
  m.resistance_Ohm = plant.resistance_Ohm;
  m.temperature_coefficient_per_K = plant.temperature_coefficient_per_K;
  m.load_N = plant.load_N;
  m.power_gain = c.power.gain;
  if (c.power.pwm_steps > 0) m.pwm_steps = c.power.pwm_steps;
  m.pwm_delay_s = whole_ticks_s(scenario, c.power.delay_s);
  m.position = converter_of(c.position_sensor);
  if (scenario.board) m.sense_filter_s = scenario.board->channels[0].heater.sense_filter_s;
  m.current.high = 20.0 * c.power.supply_V / plant.resistance_Ohm;
  m.current.low = -0.1 * m.current.high;
  return m;
}

/// Each muscle's ratio of the whole joint's stiffness.
std::array<double, 2> stiffness_ratios_of(const SimulatedBoardSettings& simulated) {
  const JointPlantSettings& joint = simulated.joints[0].plant;
  const double q = joint.antagonist_lever_ratio;
  const double radius_m = joint.lever.zero_radius_m();
  const double first = simulated.channels[0].plant.stiffness_N_per_m;
  const double second = q * q * simulated.channels[1].plant.stiffness_N_per_m;
  const double all = first + second + joint.spring_Nm_per_rad / (radius_m * radius_m);
  return {first / all, second / all};
}

void set_known(ChannelSettings& channel, const KnownBefore& known) {
  channel.muscle_identified = known.muscle_identified;
  channel.response_ratio = known.response_ratio;
  channel.unexplained_ratio = known.unexplained_ratio;
  channel.identification = known.identification;
  channel.calibration = known.calibration;
}

/// The other channel of a joint: the same position with the opposite sign, and its own muscle.
ChannelSettings antagonist_of(const Scenario& scenario, ChannelSettings channel,
                              const MuscleChannelSettings& simulated) {
  const Conditions& c = scenario.start;
  const AntagonistConditions& antagonist = *c.antagonist();
  const double resistance_Ohm = antagonist.plant.resistance_Ohm;
  const double lever_ratio = c.joint->plant.antagonist_lever_ratio;
  channel.muscle = antagonist.muscle;
  set_known(channel, scenario.known[1]);
  channel.position.scaling = mirrored(channel.position.scaling, lever_ratio);
  channel.heater.current.scaling = scaling_of(simulated.current);
  channel.heater.pwm_steps = simulated.pwm_steps;
  channel.heater.cold_resistance_Ohm = resistance_Ohm;
  channel.heater.temperature_coefficient_per_K = antagonist.plant.temperature_coefficient_per_K;
  channel.thermal = thermal_of(c, antagonist.muscle);
  channel.supervision =
      supervision_of(scenario, mirrored(c.position_sensor, lever_ratio), resistance_Ohm);
  return channel;
}

/// Another channel of a bundle: the same position, and its own heater.
ChannelSettings companion_of(const Scenario& scenario, ChannelSettings channel, std::size_t place,
                             const MuscleChannelSettings& simulated) {
  const PlantSettings& plant = scenario.start.companions[place - 1];
  set_known(channel, scenario.known[place]);
  channel.heater.current.scaling = scaling_of(simulated.current);
  channel.heater.cold_resistance_Ohm = plant.resistance_Ohm;
  channel.heater.temperature_coefficient_per_K = plant.temperature_coefficient_per_K;
  channel.supervision =
      supervision_of(scenario, scenario.start.position_sensor, plant.resistance_Ohm);
  return channel;
}

/// The highest that the operator will command.
double max_co_contraction_W(const Scenario& scenario) {
  double max_W = scenario.start.antagonist()->co_contraction_W;
  for (const Event& event : scenario.events)
    max_W = std::max(max_W, event.conditions.antagonist()->co_contraction_W);
  return max_W;
}

}  // namespace

MuscleChannelSettings muscle_channel_of(const Scenario& scenario, const Conditions& c) {
  return channel_of(scenario, c, c.plant);
}

MuscleChannelSettings companion_channel_of(const Scenario& scenario, const Conditions& c,
                                           std::size_t place) {
  MuscleChannelSettings m = channel_of(scenario, c, c.companions[place - 1]);
  if (scenario.board) {
    const HeaterSettings& heater = scenario.board->channels[place].heater;
    m.sense_filter_s = heater.sense_filter_s;
    m.pwm_delay_s = whole_ticks_s(scenario, heater.delay_s);
  }
  return m;
}

MuscleChannelSettings antagonist_channel_of(const Scenario& scenario, const Conditions& c) {
  MuscleChannelSettings m = channel_of(scenario, c, c.antagonist()->plant);
  if (c.antagonist()->pwm_steps > 0) m.pwm_steps = c.antagonist()->pwm_steps;
  if (scenario.board) {
    const HeaterSettings& heater = scenario.board->channels[1].heater;
    m.sense_filter_s = heater.sense_filter_s;
    m.pwm_delay_s = whole_ticks_s(scenario, heater.delay_s);
  }
  return m;
}

SimulatedJointSettings simulated_joint_of(const Conditions& c) {
  SimulatedJointSettings joint;
  joint.plant = c.joint->plant;
  if (!c.joint->antagonist) joint.antagonist.reset();
  joint.plant.substeps = c.plant.effects.substeps;
  joint.load_Nm = c.joint->load_Nm;
  return joint;
}

SimulatedBoardSettings simulated_board_of(const Scenario& scenario) {
  SimulatedBoardSettings s;
  s.rate_Hz = scenario.rate_Hz;
  s.substeps = scenario.substeps;
  s.supply_V = scenario.start.power.supply_V;
  s.supply.high = 2.0 * s.supply_V;
  if (scenario.start.ambient.sensor_error_K > 0.0) s.air = air_sensor;
  s.charge_pump_decay_s = pump_decay_s(scenario);
  s.seed = scenario.seed;
  s.channels = {muscle_channel_of(scenario, scenario.start)};
  if (scenario.start.antagonist() != nullptr)
    s.channels.push_back(antagonist_channel_of(scenario, scenario.start));
  if (!scenario.start.companions.empty()) s.bundles = {{0}};
  for (std::size_t i = 1; i <= scenario.start.companions.size(); ++i) {
    s.channels.push_back(companion_channel_of(scenario, scenario.start, i));
    s.bundles[0].push_back(i);
  }
  if (scenario.start.joint) s.joints = {simulated_joint_of(scenario.start)};
  return s;
}

BoardSettings firmware_of(const Scenario& scenario) {
  const SimulatedBoardSettings simulated = simulated_board_of(scenario);
  if (scenario.board) return over(*scenario.board, simulated);
  const Conditions& c = scenario.start;
  BoardSettings board;
  board.rate_Hz = scenario.rate_Hz;
  board.supply.scaling = scaling_of(simulated.supply);
  if (simulated.air) board.air.scaling = scaling_of(*simulated.air);
  board.supervision.min_supply_V = 0.6 * c.power.supply_V;
  board.supervision.max_supply_V = 1.25 * c.power.supply_V;
  board.supervision.late_s = 0.5 * scenario.step_s();
  board.supervision.charge_pump_decay_s = simulated.charge_pump_decay_s;

  ChannelSettings& channel = board.channels[0];
  channel.muscle = c.muscle;
  set_known(channel, scenario.known[0]);
  channel.position.scaling = scaling_of(simulated.channels[0].position);
  channel.heater.current.scaling = scaling_of(simulated.channels[0].current);
  channel.position.max_age_s = max_age_s(scenario, simulated.channels[0].position);
  channel.heater.current.max_age_s = max_age_s(scenario, simulated.channels[0].current);
  board.supply.max_age_s = max_age_s(scenario, simulated.supply);
  channel.heater.cold_resistance_Ohm = c.plant.resistance_Ohm;
  channel.heater.temperature_coefficient_per_K = c.plant.temperature_coefficient_per_K;
  channel.senses.error_ratio = c.sense_error_ratio;
  channel.heater.error_feedback = c.power.error_feedback;
  channel.heater.pwm_steps = simulated.channels[0].pwm_steps;
  channel.heater.delay_s = c.power.delay_s;
  channel.thermal = thermal_of(c, c.muscle);
  channel.limiter.max_W = c.power.max_W;
  channel.limiter.min_W = c.power.min_W;
  channel.supervision = supervision_of(scenario, c.position_sensor, c.plant.resistance_Ohm);
  channel.controllers = {c.controller};
  channel.estimators = {c.estimator};
  for (const Event& event : scenario.events) {
    if (event.new_controller) channel.controllers.push_back(event.conditions.controller);
    if (event.new_estimator) channel.estimators.push_back(event.conditions.estimator);
  }
  if (const AntagonistConditions* antagonist = c.antagonist()) {
    board.channels.push_back(antagonist_of(scenario, channel, simulated.channels[1]));
    JointSettings joint{.lever = c.joint->plant.lever,
                        .co_contraction_W = antagonist->co_contraction_W,
                        .antagonist_lever_ratio = c.joint->plant.antagonist_lever_ratio,
                        .pretension_N = c.joint->plant.pretension_N,
                        .stiffness_ratio = stiffness_ratios_of(simulated)};
    joint.max_co_contraction_W =
        std::max(max_co_contraction_W(scenario),
                 JointSettings::default_limit_ratio * feasible_co_contraction_W(board, joint));
    add_joint(board, joint);
  } else if (!c.companions.empty()) {
    for (std::size_t i = 1; i <= c.companions.size(); ++i)
      board.channels.push_back(companion_of(scenario, board.channels[0], i, simulated.channels[i]));
    add_bundle(board, {simulated.bundles[0]});
  } else if (c.joint) {
    channel.joint = single_muscle_place(c.joint->plant);
  }
  // From the sensor's reading to how far the muscles contract there.
  for (ChannelSettings& each : board.channels) {
    double& travel_m = each.supervision.max_travel_m;
    travel_m = each.joint.position_of_reading_m(travel_m);
  }
  return board;
}

BoardSettings forecast_board_of(const Scenario& scenario) {
  BoardSettings board = firmware_of(scenario);
  const Conditions& c = scenario.start;
  const bool alone = !c.joint && c.companions.empty();
  board.channels[0].simulated = {c.joint ? 0.0 : c.plant.load_N, alone && !c.plant.effects.any()};
  return board;
}

}  // namespace supercoil::host_sim
