// Commands from programs on the board itself, by a socket in the file system.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/descriptor.hpp"

#include "apps/supercoild/newest_rows.hpp"
#include "loop/loop.hpp"

namespace supercoil::daemon {

/// A socket of packets (SOCK_SEQPACKET): each is one line of command_text.hpp, or "state", and is
/// answered by one packet, in order. Users who may open the file may command: the folder's
/// permissions decide. A command to heat expires as everywhere, so a client that dies lets the
/// muscle cool. Used by one thread.
class LocalCommands {
 public:
  /// A file that an earlier life left is replaced: the lock is held already.
  static Result<LocalCommands> open(const std::string& path);

  /// Waits at most max_ms for something to do, and does it.
  void serve(Loop& loop, const NewestRows& rows, int max_ms);
  /// The loop's answer to a command with Source::local.
  void pass(const Answer& given, const Loop& loop);

 private:
  explicit LocalCommands(hal_linux::Descriptor listener) : listener_(std::move(listener)) {}
  void accept_one();
  bool take_packet(const hal_linux::Descriptor& client, Loop& loop, const NewestRows& rows);

  hal_linux::Descriptor listener_;
  std::vector<hal_linux::Descriptor> clients_;
  std::map<std::uint32_t, int> waiting_;  ///< whose commands the loop has not answered yet, by id
  std::uint32_t last_id_ = 0;
};

}  // namespace supercoil::daemon
