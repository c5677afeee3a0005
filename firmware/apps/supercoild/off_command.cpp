#include <cstdio>
#include <string>
#include <vector>

#include "apps/common/exit_status.hpp"
#include "apps/supercoild/commands.hpp"
#include "apps/supercoild/log.hpp"
#include "config/board_config.hpp"
#include "linux_board/lock_file.hpp"
#include "linux_board/parts.hpp"

namespace supercoil::daemon {

int off_command(const std::string& config, const std::string& run_folder) {
  const auto board = config::read_board_config(config);
  if (!board) {
    std::fputs(config::to_text(board.error()).c_str(), stderr);
    return exit_wrong_input;
  }
  const auto lock = linux_board::LockFile::take(run_folder + "/lock");
  if (!lock) {
    log(Level::problem, lock.error().text());
    return exit_failed;
  }
  // Opening a device sets it to its safe level; closing it leaves it there.
  const std::vector<std::string> missing = linux_board::open_parts(board->wiring).missing();
  if (missing.empty()) {
    log(Level::info, "everything is off");
    return exit_done;
  }
  const std::string file = config + ": ";
  for (const std::string& problem : missing)
    log(Level::problem, std::string(file).append(problem));
  log(Level::problem, "everything else is off");
  return exit_failed;
}

}  // namespace supercoil::daemon
