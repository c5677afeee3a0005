// What supercoil setup is asked for.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace supercoil::operating {

struct SetupOptions {
  std::vector<std::string> steps;  ///< of setup_steps; empty: what was not done yet
  std::string config = "/etc/supercoil/board.toml";
  int channel = 1;     ///< of the file, from 1
  std::string script;  ///< answers; empty: they are asked for
  std::string can;     ///< a bus; empty: the board on which this runs
  std::string socket = "/run/supercoil/commands";
  bool undo = false;
  bool force = false;  ///< undo also what somebody else changed
  bool json = false;
};
void add_setup(CLI::App& app, SetupOptions& options);
/// Returns the program's exit status.
int setup_command(const SetupOptions& options);

}  // namespace supercoil::operating
