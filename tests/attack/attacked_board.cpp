#include "attack/attacked_board.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "config/board_config.hpp"

namespace supercoil::test {

namespace {

/// By then the muscles must have cooled, and nothing is refused any more.
constexpr double boot_s = 3.0;
/// After it the windows of slow detectors contain the behaviour of an ordinary muscle.
constexpr double warming_s = 20.0;
constexpr double command_every_s = 0.1;

board::Devices devices_of(host_sim::SimulatedBoard& board,
                          const std::function<void(board::Devices&)>& miswire) {
  board::Devices devices = board.devices();
  miswire(devices);
  return devices;
}

}  // namespace

AttackedBoard::AttackedBoard(const Course& course, const BoardSettings& firmware,
                             const host_sim::SimulatedBoardSettings& simulated,
                             const Wiring& miswire)
    : simulated_(simulated),
      board_(simulated),
      course_(course),
      channels_(firmware.channels.size()),
      command_every_(static_cast<std::uint32_t>(command_every_s * firmware.rate_Hz)),
      loop_(firmware, devices_of(board_, miswire)),
      executive_(loop_, board_, firmware.rate_Hz) {
  board_.set_air_C(course.air_C + course.air_sensor_offset_K);
}

void AttackedBoard::watch() {
  for (std::size_t i = 0; i < channels_; ++i) {
    const double true_C = course_.air_C + board_.channel(i).temperature_rise_K();
    const Snapshot& s = channel(i).snapshot();
    damage_.hottest_C = std::max(damage_.hottest_C, true_C);
    damage_.outside_K = std::max({damage_.outside_K, true_C - s.hottest_C, s.coldest_C - true_C});
  }
  if (damage_.fault != Fault::none || state() != State::fault) return;
  damage_.fault = channel().state().first_cause();
  damage_.fault_s = elapsed_s();
  faulty_since_s_ = time_s();
}

void AttackedBoard::tick() {
  if (ticks_++ % command_every_ == 0 && time_s() > boot_s) command();
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
  if (damage_.fault == Fault::none || time_s() <= faulty_since_s_ + 1.0) return false;
  for (std::size_t i = 0; i < channels_; ++i) {
    if (board_.channel(i).true_power_W() != 0.0) return false;
  }
  return true;
}

void AttackedBoard::run_for(double duration_s) {
  since_s_ = time_s();
  while (time_s() < since_s_ + duration_s && !over())
    tick();
}

Damage AttackedBoard::run() {
  if (course_.from_start) begin_attack();
  run_for(boot_s);
  run_for(warming_s);
  if (damage_.fault != Fault::none) {
    if (course_.from_start) return damage_;
    std::cerr << course_.name << ": " << name(damage_.fault) << " before the attack\n";
    std::exit(1);
  }
  begin_attack();
  attacked_ = true;
  run_for(course_.duration_s);
  return damage_;
}

BoardSettings settings_of(const std::string& text) {
  const auto config = config::parse_board_config(text, "attacked.toml");
  if (!config) {
    std::cerr << config::to_text(config.error());
    std::exit(1);
  }
  return config->settings;
}

void AttackedBoard::harm(std::size_t i, const MuscleHarm& harm) {
  constexpr double hardly = 1e-9;
  host_sim::MuscleChannel& channel = board_.channel(i);
  host_sim::MuscleChannelSettings changed = simulated_.channels[i];
  changed.plant.heat_transfer_W_per_K *= harm.cooling_ratio / worst_configured_cooling;
  if (harm.off) changed.plant.force_per_kelvin_N_per_K *= hardly;
  channel.set(changed);
  channel.faults.switch_leak_ratio = harm.switch_leak_ratio;
  channel.faults.torn = harm.torn;
  channel.faults.slack_m = harm.slack_m;
  channel.current.set(host_sim::ConverterFaults{.gain = harm.current_gain});
}

void AttackedBoard::measure(Verb mode, double then_W) {
  if (!measure_asked_) {
    measure_asked_ = true;
    send(Verb::rest);
    return send(mode);
  }
  if (channel().snapshot().mode != Mode::power) return send(Verb::renew);
  send(Verb::power, then_W);
}

}  // namespace supercoil::test
