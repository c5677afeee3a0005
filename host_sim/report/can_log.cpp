#include "report/can_log.hpp"

#include <cerrno>
#include <utility>

#include "can_client/candump.hpp"

namespace supercoil::host_sim {

CanLog::CanLog(const std::filesystem::path& path, std::string interface)
    : out_(path, std::ios::binary), interface_(std::move(interface)) {}

void CanLog::add(const hal::CanFrame& frame, hal::Time since_start) {
  out_ << can_client::candump_line(frame, can_client::simulation_epoch + since_start, interface_);
}

Result<void> CanLog::finish() {
  out_.close();
  if (out_) return {};
  return failed_call("can.log: cannot be written", errno);
}

}  // namespace supercoil::host_sim
