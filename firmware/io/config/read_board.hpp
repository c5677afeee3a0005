// Readers of the tables that a board has once. Each finishes its section.
#pragma once

#include "config/board_config.hpp"
#include "config/read_wiring.hpp"

namespace supercoil::config {

/// [board] with [board.watchdog]: rate, tolerated lateness, charge pump, storage folder.
void read_board(Section& section, BoardConfig& config);
/// [lines]: heartbeat, stop circuit, light.
void read_lines(Section& section, WiringReader& reader, BoardWiring& wiring);
/// [supply].
void read_supply(Section section, WiringReader& reader, BoardConfig& config);

/// [ambient] with [ambient.sensor]: bounds of the air around the muscles, and its sensor.
board::AirSettings read_ambient(Section section, WiringReader& reader, BoardConfig& config);

/// When commands to a channel expire, and how many may be damaged or refused in a row.
struct CommandRules {
  double timeout_s;
  int damaged_in_a_row;
  int refused_in_a_row;
};
/// [command].
CommandRules read_command(Section section, double step_s);

/// [can]. channels: the board's, with their joints.
telemetry::CanSettings read_can(Section section, double tick_Hz,
                                const std::vector<ChannelSettings>& channels);

}  // namespace supercoil::config
