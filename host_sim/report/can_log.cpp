#include "report/can_log.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include "can_client/candump.hpp"

namespace supercoil::host_sim {

CanLog::CanLog(const std::filesystem::path& path, std::string interface)
    : out_(path, std::ios::binary), interface_(std::move(interface)) {}

void CanLog::add(const hal::CanFrame& frame, hal::Time since_start) {
  out_ << can_client::candump_line(frame, can_client::simulation_epoch + since_start, interface_);
}

tl::expected<void, std::string> CanLog::finish() {
  out_.close();
  if (out_) return {};
  return tl::unexpected("can.log: cannot be written: " + std::generic_category().message(errno));
}

}  // namespace supercoil::host_sim
