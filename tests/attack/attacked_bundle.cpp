#include "attack/attacked_bundle.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "unit/firmware/io/config/support/joint_board.hpp"

namespace supercoil::test {

namespace {

constexpr std::size_t bundled = 3;
/// So wide that nothing but heat ends a run.
constexpr double range_m = 0.300;

host_sim::SimulatedBoardSettings simulated_bundle(const Muscle& muscle) {
  host_sim::SimulatedBoardSettings s;
  s.supply = {0.0, 60.0, 16, 0.005};
  host_sim::MuscleChannelSettings channel;
  channel.plant.stiffness_N_per_m = muscle.stiffness_N_per_m;
  channel.plant.moving_mass_kg *= static_cast<double>(bundled);
  channel.plant.heat_transfer_W_per_K *= worst_configured_cooling;
  channel.pwm_steps = 4095;
  channel.position = {-0.1 * range_m, range_m, 16, 5e-6};
  channel.current = {-0.5, 30.0, 16, 0.0005};
  s.channels.assign(bundled, channel);
  s.bundles = {{0, 1, 2}};
  return s;
}

/// Two more channels like the first, without its position.
std::string bundle_text(const Muscle& muscle) {
  std::string text = small_board;
  const auto state = [&text](const std::string& key, const std::string& before, double value) {
    text = replaced(text, key + before, key + std::to_string(value));
  };
  state("min_V = ", "10.8", muscle.min_supply_V);
  state("max_V = ", "13.2", muscle.max_supply_V);
  state("max_W = ", "4.5", muscle.max_W);
  state("min_m = ", "-0.001", -0.1 * range_m);
  state("max_m = ", "0.041", range_m);
  state("max_travel_m = ", "0.025", range_m);
  for (int i = 1; i < static_cast<int>(bundled); ++i) {
    std::string more =
        replaced(second_channel, "[channel.muscle]\nheat_transfer_W_per_K = 0.0712\n", "");
    more = replaced(more, "EN2", "EN" + std::to_string(i + 1));
    more = replaced(more, "number = 1", "number = " + std::to_string(i));
    more = replaced(more, "voltage3", "voltage" + std::to_string(i + 2));
    more = replaced(more, "max_W = 4.0", "max_W = " + std::to_string(muscle.max_W));
    text += replaced(more, "max_travel_m = 0.02", "max_travel_m = " + std::to_string(range_m));
  }
  const control::PhysicalParameters one;
  const auto of_all = [](double value) { return std::to_string(bundled * value); };
  return text + "[every_channel.muscle]\nstiffness_N_per_m = " + of_all(muscle.stiffness_N_per_m) +
         "\ndamping_Ns_per_m = " + of_all(one.damping_Ns_per_m) +
         "\nforce_per_kelvin_N_per_K = " + of_all(one.force_per_kelvin_N_per_K) +
         "\nmoving_mass_kg = " + of_all(one.moving_mass_kg) +
         "\n[[bundle]]\nchannels = [1, 2, 3]\n";
}

/// As a file's defaults leave it, with the wiring of the simulated board.
BoardSettings bundle_firmware(const Muscle& muscle,
                              const host_sim::SimulatedBoardSettings& simulated, bool identified) {
  BoardSettings settings = settings_of(bundle_text(muscle));
  settings.supply.scaling = scaling_of(simulated.supply);
  for (std::size_t i = 0; i < settings.channels.size(); ++i) {
    ChannelSettings& channel = settings.channels[i];
    const host_sim::MuscleChannelSettings& soldered = simulated.channels[i];
    channel.heater.current.scaling = scaling_of(soldered.current);
    channel.position.scaling = scaling_of(simulated.channels[0].position);
    if (!identified) continue;
    channel.muscle.heat_transfer_W_per_K = soldered.plant.heat_transfer_W_per_K;
    channel.has_muscle = channel.muscle_identified = true;
    channel.senses.error_ratio = 0.02;
  }
  return settings;
}

}  // namespace

AttackedBundle::AttackedBundle(const BundleAttack& attack, const Muscle& muscle,
                               BundleActivity activity)
    : AttackedBoard({attack.name, 60.0, attack.from_start, attack.air_C},
                    bundle_firmware(muscle, simulated_bundle(muscle), attack.identified),
                    simulated_bundle(muscle),
                    [&attack](board::Devices& devices) {
                      if (attack.swapped_currents)
                        std::swap(devices.channels[1].current, devices.channels[2].current);
                    }),
      attack_(attack),
      muscle_(muscle),
      activity_(activity),
      reach_m_(muscle.max_W * simulated_.channels[0].plant.dc_gain_m_per_W()) {}

void AttackedBundle::begin_attack() {
  for (std::size_t i = 0; i < attack_.muscles.size(); ++i)
    harm(i, attack_.muscles.at(i));
  board_.bundle(0).update();
  board_.supply.set(host_sim::ConverterFaults{.gain = attack_.supply_gain});
}

/// ratio: of what max_W holds.
void AttackedBundle::follow(double ratio) {
  send(Verb::position, ratio * reach_m_);
}

void AttackedBundle::command_active() {
  if (!attacked()) return follow(0.4);
  switch (activity_) {
    case BundleActivity::power:
      return send(Verb::power, muscle_.max_W);
    case BundleActivity::press:
      return follow(press_ratio);
    case BundleActivity::rearm:
      if (is_rearmed()) return send(Verb::disarm);
      return send(Verb::power, muscle_.max_W);
    case BundleActivity::identify:
      return measure(Verb::identify, muscle_.max_W);
    case BundleActivity::calibrate:
      return measure(Verb::calibrate, muscle_.max_W);
    default:
      return follow(hold_ratio);
  }
}

void AttackedBundle::command() {
  if (activity_ == BundleActivity::disarmed && attacked()) return send(Verb::disarm);
  if (state() == State::disarmed) return send(Verb::arm);
  if (state() == State::armed && measure_asked()) return send(Verb::power, muscle_.max_W);
  if (state() == State::armed) return follow(0.4);
  if (state() == State::active) command_active();
}

}  // namespace supercoil::test
