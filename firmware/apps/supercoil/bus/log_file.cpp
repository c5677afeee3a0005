#include "apps/supercoil/bus/log_file.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "can_client/candump.hpp"

namespace supercoil::operating {

Result<CanLogFile> read_can_log(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return failure(path + ": is a folder, not a log");
  std::ifstream in(path, std::ios::binary);
  if (!in) return failed_call(path + ": cannot be read", errno);
  CanLogFile log;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto read = can_client::parse_candump_line(line);
    if (!read) {
      if (log.damaged_lines++ == 0)
        log.damage = path + ":" + std::to_string(number) + ": " + read.error().text();
    } else if (read->is_standard) {
      log.frames.push_back(read->frame);
      log.frames.back().received = can_client::time_of_run(read->frame.received);
    } else {
      ++log.foreign_lines;
    }
  }
  if (in.bad()) return failed_call(path + ": cannot be read to its end", errno);
  if (log.frames.empty() && log.foreign_lines == 0) {
    return failure(log.damage.empty() ? path + ": is empty"
                                      : log.damage + ": not a candump -L log");
  }
  return log;
}

}  // namespace supercoil::operating
