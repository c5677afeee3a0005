// CAN interfaces and their sockets, without a kernel that has CAN.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <linux/can.h>

#include "unit/hal_linux/support/temporary_folder.hpp"

namespace supercoil::test {

/// While it lives, CAN sockets are ends of datagram pairs whose other ends are here. It does not
/// filter: what it was told to let through is noted.
class CanKernel {
 public:
  CanKernel();
  CanKernel(const CanKernel&) = delete;
  CanKernel& operator=(const CanKernel&) = delete;
  ~CanKernel();

  /// An interface that is up. type: ARPHRD_CAN, or another.
  void plug(const std::string& name, int index, int type = 280) const;
  /// As `ip link set NAME down`, and up again: the open socket hears of it once.
  void set_down(const std::string& name);
  void set_up(const std::string& name) const;
  void lose_carrier(const std::string& name) const;
  void unplug(const std::string& name);

  /// Something comes from the bus.
  void deliver(const void* packet, std::size_t bytes) const;
  void deliver(std::uint32_t id, std::initializer_list<std::uint8_t> data = {}) const;
  /// What was sent to the bus.
  std::optional<can_frame> sent() const;

  /// The other end of a socket that was just opened.
  void take_peer(int file);

  TemporaryFolder net;
  std::vector<can_filter> filters;
  can_err_mask_t reported_errors = 0;
  int bound_to = 0;
  int sockets = 0;                 ///< opened so far
  std::deque<int> receive_errors;  ///< for the next calls of recvmsg
  int flood = 0;                   ///< remote frames that come before all else
  int socket_error = 0;            ///< of every call of socket from now on
  int option_error = 0;            ///< of every call of setsockopt
  bool from_this_machine = false;  ///< what is delivered

 private:
  int peer_ = -1;
};

}  // namespace supercoil::test
