// CAN interfaces and their sockets, on a kernel without CAN.
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

/// During its lifetime, CAN sockets are ends of datagram pairs whose other ends are here. It does
/// not filter, but records the filters that are set.
class CanKernel {
 public:
  CanKernel();
  CanKernel(const CanKernel&) = delete;
  CanKernel& operator=(const CanKernel&) = delete;
  ~CanKernel();

  /// Adds an interface that is up. type: ARPHRD_CAN, or another.
  void plug(const std::string& name, int index, int type = 280) const;
  /// Like `ip link set NAME down` and up: the open socket is notified once.
  void set_down(const std::string& name);
  void set_up(const std::string& name) const;
  void lose_carrier(const std::string& name) const;
  void unplug(const std::string& name);

  /// A packet arrives from the bus.
  void deliver(const void* packet, std::size_t bytes) const;
  void deliver(std::uint32_t id, std::initializer_list<std::uint8_t> data = {}) const;
  /// The next frame that was sent to the bus.
  std::optional<can_frame> sent() const;

  /// Takes the other end of a socket that was just opened.
  void take_peer(int file);

  TemporaryFolder net;
  std::vector<can_filter> filters;
  can_err_mask_t reported_errors = 0;
  int bound_to = 0;
  int sockets = 0;                 ///< opened so far
  std::deque<int> receive_errors;  ///< for the next calls of recvmsg
  int flood = 0;                   ///< remote frames that come before everything else
  int socket_error = 0;            ///< for every later call of socket
  int option_error = 0;            ///< for every call of setsockopt
  bool from_this_machine = false;  ///< whether delivered frames come from this machine

 private:
  int peer_ = -1;
};

}  // namespace supercoil::test
