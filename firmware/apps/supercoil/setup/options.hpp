// Options of supercoil setup.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/supercoil/board_socket.hpp"

namespace CLI {
class App;
}

namespace supercoil::operating {

inline constexpr const char* default_config = "/etc/supercoil/board.toml";

struct SetupOptions {
  std::vector<std::string> steps;  ///< of setup_steps; empty: those not done yet
  std::string config = default_config;
  int channel = 1;     ///< of the file, from 1
  std::string script;  ///< file of answers; empty: the user is asked
  std::string can;     ///< a bus; empty: the board on which this runs
  std::string socket = default_socket;
  bool undo = false;
  bool force = false;  ///< undo also what somebody else changed
  bool json = false;

  /// " --can can0" or " --socket PATH", as commands to this board take it; empty: neither is
  /// needed.
  std::string board_words() const { return can.empty() ? socket_words(socket) : " --can " + can; }
  /// "supercoil setup calibrate --config board.toml --can can0"
  std::string command(std::string_view step) const {
    std::string line = "supercoil setup " + std::string(step);
    if (config != default_config) line += " --config " + config;
    if (channel != 1) line += " --channel " + std::to_string(channel);
    return line + board_words();
  }
};
void add_setup(CLI::App& app, SetupOptions& options);
/// Returns the program's exit status.
int setup_command(const SetupOptions& options);

}  // namespace supercoil::operating
