#include "attack/attacked_joint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "unit/firmware/io/config/support/joint_board.hpp"

namespace supercoil::test {

namespace {

constexpr double sine_Hz = 0.1;
/// Of the sensor and of the pulley; so wide that nothing but heat ends a run.
constexpr double half_range_m = 0.060;

double duration_s(JointActivity activity) {
  return activity == JointActivity::identify ? 100.0 : 60.0;
}

host_sim::SimulatedBoardSettings simulated_joint(const Muscle& muscle) {
  host_sim::SimulatedBoardSettings s;
  s.supply = {0.0, 60.0, 16, 0.005};
  host_sim::MuscleChannelSettings channel;
  channel.plant.stiffness_N_per_m = muscle.stiffness_N_per_m;
  channel.plant.heat_transfer_W_per_K *= worst_configured_cooling;
  channel.pwm_steps = 4095;
  channel.position = {-half_range_m, half_range_m, 16, 5e-6};
  channel.current = {-0.5, 30.0, 16, 0.0005};
  s.channels = {channel, channel};
  host_sim::JointPlantSettings joint;
  joint.max_angle_rad = half_range_m / joint.lever.zero_radius_m();
  joint.min_angle_rad = -joint.max_angle_rad;
  s.joints = {{0, 1, joint, 0.0}};
  return s;
}

/// As a file's defaults leave it, with the wiring of the simulated board.
BoardSettings joint_firmware(const Muscle& muscle,
                             const host_sim::SimulatedBoardSettings& simulated, bool identified) {
  const double lever_m = simulated.joints[0].plant.lever.zero_radius_m();
  std::string text = board_with_joint;
  const auto state = [&text](const std::string& key, const std::string& before, double value) {
    text = replaced(text, key + before, key + std::to_string(value));
  };
  state("min_V = ", "10.8", muscle.min_supply_V);
  state("max_V = ", "13.2", muscle.max_supply_V);
  state("max_W = ", "4.5", muscle.max_W);
  state("max_W = ", "4.0", muscle.max_W);
  state("min_m = ", "-0.041", -half_range_m);
  state("max_m = ", "0.041", half_range_m);
  state("max_travel_m = ", "0.025", half_range_m);
  state("max_travel_m = ", "0.02", half_range_m);
  text = replaced(text, "[channel.muscle]\nheat_transfer_W_per_K = 0.0712\n", "");
  text += "[every_channel.muscle]\nstiffness_N_per_m = " +
          std::to_string(2.0 * muscle.stiffness_N_per_m) +
          "\ndamping_Ns_per_m = 4.0\nmoving_mass_kg = " +
          std::to_string(simulated.joints[0].plant.inertia_kg_m2 / (lever_m * lever_m)) +
          "\n[every_channel.controller]\nkind = 'learned_ff'\n";
  BoardSettings settings = settings_of(text);
  settings.supply.scaling = scaling_of(simulated.supply);
  for (std::size_t i = 0; i < settings.channels.size(); ++i) {
    ChannelSettings& channel = settings.channels[i];
    const host_sim::MuscleChannelSettings& soldered = simulated.channels[i];
    channel.heater.current.scaling = scaling_of(soldered.current);
    channel.position.scaling = scaling_of(soldered.position);
    if (i == 1) {
      channel.position.scaling.per_count *= -1.0;
      channel.position.scaling.offset *= -1.0;
    }
    if (!identified) continue;
    channel.muscle.heat_transfer_W_per_K = soldered.plant.heat_transfer_W_per_K;
    channel.has_muscle = channel.muscle_identified = true;
    channel.senses.error_ratio = 0.02;
  }
  return settings;
}

}  // namespace

AttackedJoint::AttackedJoint(const JointAttack& attack, const Muscle& muscle,
                             JointActivity activity)
    : AttackedBoard({attack.name, duration_s(activity), attack.from_start, attack.air_C},
                    joint_firmware(muscle, simulated_joint(muscle), attack.identified),
                    simulated_joint(muscle),
                    [&attack](board::Devices& devices) {
                      board::ChannelDevices& a = devices.channels[0];
                      board::ChannelDevices& b = devices.channels[1];
                      if (attack.swapped_heaters) {
                        std::swap(a.pwm, b.pwm);
                        std::swap(a.enable, b.enable);
                      }
                      if (attack.swapped_currents) std::swap(a.current, b.current);
                    }),
      attack_(attack),
      muscle_(muscle),
      activity_(activity) {
  const control::PhysicalParameters& plant = simulated_.channels[0].plant;
  // Both springs hold it back.
  reach_m_ = 0.5 * muscle.max_W * plant.dc_gain_m_per_W();
}

void AttackedJoint::begin_attack() {
  for (std::size_t i = 0; i < attack_.muscles.size(); ++i)
    harm(i, attack_.muscles.at(i));
  board_.channel(0).position.set(host_sim::ConverterFaults{.gain = attack_.position_gain});
  board_.supply.set(host_sim::ConverterFaults{.gain = attack_.supply_gain});
  host_sim::SimulatedJointSettings joint = simulated_.joints[0];
  if (attack_.jammed)
    joint.plant.min_angle_rad = joint.plant.max_angle_rad = board_.joint(0).plant().angle_rad();
  board_.joint(0).set(joint);
}

/// ratio: of what max_W of the agonist holds.
void AttackedJoint::follow(double ratio) {
  send(Verb::position, ratio * reach_m_);
}

void AttackedJoint::command_active() {
  if (!attacked()) return follow(0.5);
  switch (activity_) {
    case JointActivity::sine:
      return follow(hold_ratio * std::sin(2.0 * std::numbers::pi * sine_Hz * elapsed_s()));
    case JointActivity::pull:
      follow(0.0);
      return send(Verb::power, 0.5 * muscle_.max_W, 1);
    case JointActivity::press:
      return follow(press_ratio);
    case JointActivity::rearm:
      if (is_rearmed()) return send(Verb::disarm);
      return follow(press_ratio);
    case JointActivity::identify:
      return measure(Verb::identify, muscle_.max_W);
    case JointActivity::alone:
      if (channel().snapshot().mode == Mode::position) send(Verb::rest);
      return send(Verb::power, muscle_.max_W);
    default:
      return follow(hold_ratio);
  }
}

void AttackedJoint::command() {
  if (activity_ == JointActivity::disarmed && attacked()) return send(Verb::disarm);
  if (state() == State::disarmed) return send(Verb::arm);
  if (state() == State::armed && measure_asked()) return send(Verb::power, muscle_.max_W);
  if (state() == State::armed) return follow(0.5);
  if (state() == State::active) command_active();
}

}  // namespace supercoil::test
