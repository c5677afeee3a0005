// The thread between the loop and whoever commands.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "supercoil/hal_linux/thread.hpp"

#include "daemon/local_commands.hpp"

namespace supercoil::daemon {

/// Serves commands and shows the loop that it lives. Touches no disk: so it is the one that cools
/// at a SIGTERM or SIGINT that is blocked and pending, however long the main thread waits for a
/// disk.
class Telemetry {
 public:
  Telemetry(Loop& loop, NewestRows& rows, std::optional<LocalCommands> commands)
      : loop_(&loop), rows_(&rows), commands_(std::move(commands)) {}
  ~Telemetry() { ending_ = true; }

  tl::expected<void, std::string> start();
  /// From now on every channel is told to disarm, again and again, and nobody else is heard.
  void cool() { cooling_.store(true, std::memory_order_relaxed); }

 private:
  void run();

  Loop* loop_;
  NewestRows* rows_;
  std::optional<LocalCommands> commands_;
  std::uint32_t beats_ = 0;
  std::atomic<bool> cooling_{false};
  std::atomic<bool> ending_{false};
  std::unique_ptr<hal_linux::Thread> thread_;  ///< last: it ends first
};

}  // namespace supercoil::daemon
