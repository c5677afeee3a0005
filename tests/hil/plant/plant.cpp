#include "plant.hpp"

#include <numbers>

namespace supercoil::rig {

namespace {

// An ADS1115 whose full scale is 4.096 V: 125 uV a count, none below 0 V.
host_sim::ConverterSettings converter(double unit_per_V, double noise_rms, double at_0_V = 0.0) {
  constexpr double full_scale_V = 32767 * 125e-6;
  return {at_0_V, at_0_V + full_scale_V * unit_per_V, 15, noise_rms};
}

// An AS5600 as in firmware/io/config/examples/joint-as5600-ads1115.toml: 90 degrees over 3.3 V, as
// an arc.
host_sim::ConverterSettings angle_sensor(double lever_m, double noise_rms_m) {
  const double range_m = lever_m * 0.5 * std::numbers::pi;
  return converter(range_m / 3.3, noise_rms_m, -0.5 * range_m);
}

// Sensors as in firmware/io/config/examples/raspberry-pi-pca9685-ads1115.toml.
host_sim::SimulatedBoardSettings board_of(const PlantSettings& settings) {
  host_sim::MuscleChannelSettings channel;
  channel.sense_filter_s = settings.sense_filter_ms / 1000.0;
  channel.pwm_steps = 4096;
  channel.position = converter(0.040 / 3.3, settings.position_noise_m);
  channel.current = converter(1.0, 0.0005);
  host_sim::SimulatedBoardSettings board;
  board.rate_Hz = settings.rate_Hz;
  board.supply_V = settings.supply_V;
  board.supply = converter(4.3, 0.001);
  board.charge_pump_decay_s = settings.charge_pump_decay_ms / 1000.0;
  board.seed = settings.seed;
  board.channels.assign(static_cast<std::size_t>(settings.channels), channel);
  if (settings.joint) {
    const host_sim::SimulatedJointSettings joint;
    board.channels[joint.agonist].position =
        angle_sensor(joint.plant.lever.zero_radius_m(), settings.position_noise_m);
    board.joints = {joint};
  }
  return board;
}

}  // namespace

Plant::Plant(const PlantSettings& settings)
    : board_(board_of(settings)),
      pwm_(settings.i2c_bus, settings.pwm_address),
      supply_(settings.i2c_bus, settings.first_converter),
      heartbeat_line_(settings.lines + "/HEARTBEAT"),
      stop_line_(settings.lines + "/STOP"),
      light_line_(settings.lines + "/LIGHT"),
      duties_(static_cast<std::size_t>(settings.channels)) {
  for (int channel = 0; channel < settings.channels; ++channel) {
    // As guest/functions gives them to i2c-stub and the drivers.
    const int position = settings.first_converter + 1 + 2 * channel;
    positions_.emplace_back(settings.i2c_bus, position);
    currents_.emplace_back(settings.i2c_bus, position + 1);
    enable_lines_.emplace_back(settings.lines + "/ENABLE" + std::to_string(channel));
  }
}

void Plant::step(hal::Time now, bool slow) {
  board_.advance_to(now);
  for (std::size_t i = 0; i < channels(); ++i) {
    positions_[i].show(board_.channel(i).position.latest().counts);
    currents_[i].show(board_.channel(i).current.latest().counts);
  }

  if (slow) {
    supply_.show(board_.supply.latest().counts);
    stop_closed_ = stop_line_.high();
    light_ = light_line_.high();
  }
  // The stop's second contact cuts the heartbeat off the pump (docs/wiring.md).
  const bool heartbeat = heartbeat_line_.high();
  if (stop_closed_) board_.heartbeat.set(heartbeat);
  const auto registers = pwm_.first_registers();
  for (std::size_t i = 0; i < channels(); ++i) {
    duties_[i] = pca9685_high(registers, static_cast<int>(i));
    board_.channel(i).pwm.set(duties_[i]);
    board_.channel(i).enable.set(enable_lines_[i].high());
  }
}

}  // namespace supercoil::rig
