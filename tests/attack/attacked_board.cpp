#include "attack/attacked_board.hpp"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <utility>

#include "config/board_config.hpp"
#include "unit/firmware/io/config/support/small_board.hpp"

namespace supercoil::test {

namespace {

/// Until the muscle must be cool, and nothing is refused any more.
constexpr double boot_s = 3.0;
/// After it the windows of slow detectors hold an ordinary muscle.
constexpr double warming_s = 20.0;
constexpr double warm_ratio = 0.6;     ///< of max_W, while it is warmed
constexpr double hold_ratio = 0.8;     ///< of what max_W would hold
constexpr double ramp_per_s = 1.5e-3;  ///< of max_W: below what heater_not_responding judges
constexpr double rearm_every_s = 12.0;
/// Commands expire after 0.25 s.
constexpr std::uint32_t command_every = 100;

double duration_s(Activity activity) {
  switch (activity) {
    case Activity::ramp:
      return 150.0;
    case Activity::identify:
    case Activity::calibrate:
      return 100.0;
    default:
      return 60.0;
  }
}

host_sim::SimulatedBoardSettings simulated_board(const Muscle& muscle, bool measures_air) {
  host_sim::SimulatedBoardSettings s;
  s.supply = {0.0, 60.0, 16, 0.005};
  if (measures_air) s.air = {-60.0, 140.0, 12, 0.1};
  host_sim::MuscleChannelSettings& channel = s.channels.front();
  channel.plant.stiffness_N_per_m = muscle.stiffness_N_per_m;
  channel.plant.heat_transfer_W_per_K *= worst_configured_cooling;
  channel.pwm_steps = 4095;
  channel.position = {0.0, 0.080, 16, 10e-6};
  channel.current = {-0.5, 30.0, 16, 0.0005};
  return s;
}

/// As a file's defaults leave it. What is soldered is the simulated board's.
BoardSettings firmware(const Muscle& muscle, const host_sim::SimulatedBoardSettings& simulated,
                       bool identified) {
  std::string text = small_board;
  const auto state = [&text](const std::string& key, const std::string& before, double value) {
    text.replace(text.find(key + before), (key + before).size(), key + std::to_string(value));
  };
  state("min_V = ", "10.8", muscle.min_supply_V);
  state("max_V = ", "13.2", muscle.max_supply_V);
  state("max_W = ", "4.5", muscle.max_W);
  if (simulated.air) {
    text += "[ambient.sensor]\ndevice = 'adc'\ninput = 'temp'\nC_per_count = " +
            std::to_string(simulated.air->per_count()) + "\n";
  }
  // Where nothing limits the travel, nothing but heat ends a run.
  state("max_m = ", "0.041", 0.081);
  state("max_travel_m = ", "0.025", 0.08);
  text += "[channel.muscle]\nstiffness_N_per_m = " + std::to_string(muscle.stiffness_N_per_m) +
          "\n[channel.controller]\nkind = 'pi'\n";
  const auto config = config::parse_board_config(text, "attacked.toml");
  if (!config) {
    std::cerr << config::to_text(config.error());
    std::exit(1);
  }
  BoardSettings settings = config->settings;
  const auto scaling = [](const host_sim::ConverterSettings& converter) {
    return board::Scaling{converter.per_count(), converter.low};
  };
  const host_sim::MuscleChannelSettings& soldered = simulated.channels.front();
  settings.supply.scaling = scaling(simulated.supply);
  if (simulated.air) settings.air.scaling = scaling(*simulated.air);
  settings.channels[0].position.scaling = scaling(soldered.position);
  settings.channels[0].heater.current.scaling = scaling(soldered.current);
  if (identified) {
    settings.channels[0].muscle = soldered.plant;
    settings.channels[0].has_muscle = settings.channels[0].muscle_identified = true;
    settings.channels[0].senses.error_ratio = 0.02;
  }
  return settings;
}

}  // namespace

AttackedBoard::AttackedBoard(Attack attack, const Muscle& muscle, Activity activity)
    : attack_(std::move(attack)),
      muscle_(muscle),
      activity_(activity),
      simulated_(simulated_board(muscle, attack_.air_sensor_offset_K.has_value())),
      board_(simulated_),
      loop_(firmware(muscle, simulated_, attack_.identified), board_.devices()),
      executive_(loop_, board_, simulated_.rate_Hz) {
  board_.set_air_C(attack_.air_C + attack_.air_sensor_offset_K.value_or(0.0));
}

void AttackedBoard::begin_attack() {
  host_sim::MuscleChannel& channel = board_.channel(0);
  host_sim::MuscleChannelSettings changed = simulated_.channels.front();
  changed.plant.heat_transfer_W_per_K *= attack_.cooling_ratio / worst_configured_cooling;
  channel.set(changed);
  channel.faults.slack = attack_.blocked;
  channel.faults.switch_leak_ratio = attack_.switch_leak_ratio;
  channel.current.set(host_sim::ConverterFaults{.gain = attack_.current_gain});
  board_.supply.set(host_sim::ConverterFaults{.gain = attack_.supply_gain});
}

void AttackedBoard::command_active() {
  const double elapsed_s = time_s() - since_s_;
  const double max_W = muscle_.max_W;
  if (!attacked_) return send(Verb::power, warm_ratio * max_W);
  switch (activity_) {
    case Activity::hold:
      return send(Verb::position,
                  hold_ratio * max_W * simulated_.channels.front().plant.dc_gain_m_per_W());
    case Activity::ramp:
      return send(Verb::power, max_W * std::min(1.0, warm_ratio + ramp_per_s * elapsed_s));
    case Activity::identify:
    case Activity::calibrate:
      if (loop_.channel(0).snapshot().mode == Mode::power && mode_asked_) {
        return send(Verb::power, max_W);  // the mode has ended
      }
      if (mode_asked_) return send(Verb::renew);
      mode_asked_ = true;
      send(Verb::rest);
      return send(activity_ == Activity::identify ? Verb::identify : Verb::calibrate);
    case Activity::rearm:
      if (std::fmod(elapsed_s, rearm_every_s) >= rearm_every_s - 0.3) return send(Verb::disarm);
      return send(Verb::power, max_W);
    default:
      return send(Verb::power, max_W);
  }
}

void AttackedBoard::command() {
  if (activity_ == Activity::disarmed && attacked_) return send(Verb::disarm);
  if (state() == State::disarmed) return send(Verb::arm);
  if (state() == State::armed) return send(Verb::power, warm_ratio * muscle_.max_W);
  if (state() == State::active) command_active();
}

void AttackedBoard::watch() {
  const double true_C = attack_.air_C + board_.channel(0).temperature_rise_K();
  const Snapshot& s = loop_.channel(0).snapshot();
  damage_.hottest_C = std::max(damage_.hottest_C, true_C);
  damage_.outside_K = std::max({damage_.outside_K, true_C - s.hottest_C, s.coldest_C - true_C});
  if (damage_.fault != Fault::none || state() != State::fault) return;
  damage_.fault = loop_.channel(0).state().first_cause();
  damage_.fault_s = time_s() - since_s_;
  faulty_since_s_ = time_s();
}

void AttackedBoard::tick() {
  if (ticks_++ % command_every == 0 && time_s() > boot_s) command();
  executive_.run_tick();
  loop_.health().telemetry_heartbeats.store(ticks_);
  for (Row row; loop_.take(row);) {
  }
  for (Answer answer; loop_.answer(answer);) {
  }
  watch();
}

/// Nothing heats any more, and nobody resets.
bool AttackedBoard::over() const {
  return damage_.fault != Fault::none && time_s() > faulty_since_s_ + 1.0 &&
         board_.channel(0).true_power_W() == 0.0;
}

void AttackedBoard::run_for(double duration_s) {
  since_s_ = time_s();
  while (time_s() < since_s_ + duration_s && !over())
    tick();
}

Damage AttackedBoard::run() {
  if (attack_.from_start) begin_attack();
  run_for(boot_s);
  run_for(warming_s);
  if (damage_.fault != Fault::none) {
    if (attack_.from_start) return damage_;
    std::cerr << attack_.name << ": " << name(damage_.fault) << " before the attack\n";
    std::exit(1);
  }
  begin_attack();
  attacked_ = true;
  run_for(duration_s(activity_));
  return damage_;
}

}  // namespace supercoil::test
