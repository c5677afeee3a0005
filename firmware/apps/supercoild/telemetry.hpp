// The thread between the loop and its clients.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/thread.hpp"

#include "apps/supercoild/local_commands.hpp"
#include "apps/supercoild/row_relay.hpp"
#include "telemetry/can_endpoint.hpp"

namespace supercoil::daemon {

/// Takes the loop's rows, sends and receives on the CAN bus, serves commands, and shows the loop
/// that it is alive. It never touches a disk, so this thread cools the muscles when a blocked
/// ending signal is pending, however long the main thread waits for a disk. Only this thread
/// accesses the loop's commands, answers and rows.
class Telemetry {
 public:
  /// relay: receives the rows. can: null for a board without a bus. All outlive it.
  Telemetry(Loop& loop, RowRelay& relay, std::optional<LocalCommands> commands,
            telemetry::CanEndpoint* can = nullptr)
      : loop_(&loop),
        relay_(&relay),
        commands_(std::move(commands)),
        can_(can),
        rows_(loop.channels()) {}
  ~Telemetry() { ending_ = true; }

  Result<void> start();
  /// From now on every channel is repeatedly told to disarm. The bus and other commands are no
  /// longer served.
  void cool() { cooling_.store(true, std::memory_order_relaxed); }

 private:
  void run();
  void disarm_all();
  void pass_rows();
  void pass_answers();

  Loop* loop_;
  RowRelay* relay_;
  std::optional<LocalCommands> commands_;
  telemetry::CanEndpoint* can_;
  NewestRows rows_;
  std::uint32_t beats_ = 0;
  std::atomic<bool> cooling_{false};
  std::atomic<bool> ending_{false};
  std::unique_ptr<hal_linux::Thread> thread_;  ///< last, so that it ends first
};

}  // namespace supercoil::daemon
