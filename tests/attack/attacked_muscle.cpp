#include "attack/attacked_muscle.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "unit/firmware/io/config/support/small_board.hpp"

namespace supercoil::test {

namespace {

constexpr double warm_ratio = 0.6;     ///< of max_W, while it is warmed
constexpr double ramp_per_s = 1.5e-3;  ///< of max_W: below what heater_not_responding judges

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

host_sim::SimulatedBoardSettings simulated_muscle(const Attack& attack, const Muscle& muscle) {
  host_sim::SimulatedBoardSettings s;
  s.supply = {0.0, 60.0, 16, 0.005};
  if (attack.air_sensor_offset_K) s.air = {-60.0, 140.0, 12, 0.1};
  host_sim::MuscleChannelSettings& channel = s.channels.front();
  channel.plant.stiffness_N_per_m = muscle.stiffness_N_per_m;
  channel.plant.heat_transfer_W_per_K *= worst_configured_cooling;
  channel.pwm_steps = 4095;
  channel.position = {0.0, 0.080, 16, 10e-6};
  channel.current = {-0.5, 30.0, 16, 0.0005};
  return s;
}

/// As a file's defaults leave it, with the wiring of the simulated board.
BoardSettings muscle_firmware(const Muscle& muscle,
                              const host_sim::SimulatedBoardSettings& simulated, bool identified) {
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
  BoardSettings settings = settings_of(text);
  const host_sim::MuscleChannelSettings& soldered = simulated.channels.front();
  settings.supply.scaling = scaling_of(simulated.supply);
  if (simulated.air) settings.air.scaling = scaling_of(*simulated.air);
  settings.channels[0].position.scaling = scaling_of(soldered.position);
  settings.channels[0].heater.current.scaling = scaling_of(soldered.current);
  if (identified) {
    settings.channels[0].muscle = soldered.plant;
    settings.channels[0].has_muscle = settings.channels[0].muscle_identified = true;
    settings.channels[0].senses.error_ratio = 0.02;
  }
  return settings;
}

}  // namespace

AttackedMuscle::AttackedMuscle(const Attack& attack, const Muscle& muscle, Activity activity)
    : AttackedBoard({attack.name, duration_s(activity), attack.from_start, attack.air_C,
                     attack.air_sensor_offset_K.value_or(0.0)},
                    muscle_firmware(muscle, simulated_muscle(attack, muscle), attack.identified),
                    simulated_muscle(attack, muscle)),
      attack_(attack),
      muscle_(muscle),
      activity_(activity) {}

void AttackedMuscle::begin_attack() {
  harm(0, {.current_gain = attack_.current_gain,
           .cooling_ratio = attack_.cooling_ratio,
           .switch_leak_ratio = attack_.switch_leak_ratio});
  board_.channel(0).faults.slack = attack_.blocked;
  board_.supply.set(host_sim::ConverterFaults{.gain = attack_.supply_gain});
}

void AttackedMuscle::command_active() {
  const double max_W = muscle_.max_W;
  if (!attacked()) return send(Verb::power, warm_ratio * max_W);
  switch (activity_) {
    case Activity::hold:
      return send(Verb::position,
                  hold_ratio * max_W * simulated_.channels.front().plant.dc_gain_m_per_W());
    case Activity::ramp:
      return send(Verb::power, max_W * std::min(1.0, warm_ratio + ramp_per_s * elapsed_s()));
    case Activity::identify:
    case Activity::calibrate:
      return measure(activity_ == Activity::identify ? Verb::identify : Verb::calibrate, max_W);
    case Activity::rearm:
      if (is_rearmed()) return send(Verb::disarm);
      return send(Verb::power, max_W);
    case Activity::rests:
      return rests() ? send(Verb::rest) : send(Verb::power, max_W);
    default:
      return send(Verb::power, max_W);
  }
}

void AttackedMuscle::command() {
  if (activity_ == Activity::disarmed && attacked()) return send(Verb::disarm);
  if (state() == State::disarmed) return send(Verb::arm);
  if (state() == State::armed) return send(Verb::power, warm_ratio * muscle_.max_W);
  if (state() == State::active) command_active();
}

}  // namespace supercoil::test
