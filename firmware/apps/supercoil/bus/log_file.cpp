#include "apps/supercoil/bus/log_file.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "apps/supercoil/bus/recent.hpp"
#include "can_client/candump.hpp"
#include "text/number_text.hpp"

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
      hal::CanFrame frame = read->frame;
      frame.received = can_client::time_of_run(frame.received);
      if (log.goes_back.empty() && !log.frames.empty() &&
          is_restart(log.frames.back().received, frame.received)) {
        log.goes_back = path + ":" + std::to_string(number) + ": is " +
                        number_text(hal::seconds(log.frames.back().received - frame.received), 6) +
                        " s before the line before it";
      }
      log.frames.push_back(frame);
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
