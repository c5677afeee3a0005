// Commands from programs on the board itself, over a socket in the file system.
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

/// A socket of packets (SOCK_SEQPACKET): each packet is one line of command_text.hpp, a request
/// about tuning (local_tuning.hpp), or "state", "status", "senses", "muscle" or "playback". It gets
/// one packet as its answer; commands are answered in order, by the loop. Users who may open the
/// file may command: the folder's permissions decide. A command to heat expires as everywhere, so a
/// client that dies lets the muscle cool. Used by one thread.
class LocalCommands {
 public:
  /// Replaces a file left over from an earlier run: the lock is held already.
  static Result<LocalCommands> open(const std::string& path);

  /// Waits at most max_ms for requests, and serves them.
  void serve(Loop& loop, const NewestRows& rows, int max_ms);
  /// The loop's answer to a command with Source::local.
  void pass(const Answer& given, const Loop& loop);

 private:
  explicit LocalCommands(hal_linux::Descriptor listener) : listener_(std::move(listener)) {}
  void accept_one();
  bool take_packet(const hal_linux::Descriptor& client, Loop& loop, const NewestRows& rows);

  hal_linux::Descriptor listener_;
  std::vector<hal_linux::Descriptor> clients_;
  std::map<std::uint32_t, int> waiting_;  ///< the clients to answer, by command id
  std::uint32_t last_id_ = 0;
};

}  // namespace supercoil::daemon
