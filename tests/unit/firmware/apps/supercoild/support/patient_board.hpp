// A board that tolerates starved threads: a busy test machine must not cause a fault.
#pragma once

#include <string>

#include "config/board_config.hpp"
#include "loop/support/rig.hpp"

namespace supercoil::test {

/// Runs at 200 Hz.
inline RigSettings patient_board() {
  RigSettings s = rough_board();
  s.board.rate_Hz = s.firmware.rate_Hz = 200.0;
  BoardSupervision& board = s.firmware.supervision;
  s.board.charge_pump_decay_s = board.charge_pump_decay_s = 1.01;
  board.overruns_in_a_row = 100;
  board.late_in_a_row = 1000;
  board.telemetry_timeout_s = 30.0;
  for (ChannelSettings& channel : s.firmware.channels) {
    channel.thermal.boot_rise_K = 0.0;
    channel.supervision.command_timeout_s = 2.0;
    channel.position.max_age_s = channel.heater.current.max_age_s = 5.0;
  }
  s.firmware.supply.max_age_s = 5.0;
  return s;
}

/// The daemon's configuration for these settings; it stores in this folder.
inline config::BoardConfig config_of(const BoardSettings& settings, const std::string& folder) {
  config::BoardConfig config;
  config.name = "test";
  config.settings = settings;
  config.storage_folder = folder;
  for (std::size_t i = 0; i < settings.channels.size(); ++i)
    config.labels.emplace_back().name = "muscle " + std::to_string(i + 1);
  return config;
}

}  // namespace supercoil::test
