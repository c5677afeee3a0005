// STOP, independent of everything else the monitor does.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "apps/supercoil/bus/recent.hpp"
#include "apps/supercoil/monitor/access.hpp"
#include "apps/supercoil/monitor/manual_control.hpp"
#include "apps/supercoil/monitor/stop_listener.hpp"
#include "can_client/master.hpp"

namespace supercoil::operating {

/// POST /stop to a port of its own disarms every node that was heard, and tells which of them did
/// not confirm it. One thread listens and never waits; another has its own connection to the bus,
/// opened before it is needed.
class StopServer {
 public:
  /// Identifiers of the frames with which any node confirms a disarm.
  static std::vector<std::uint16_t> received_ids();
  /// release_hold: tells the manual controls, without waiting. port: the one after the page's if it
  /// is free, else any. frame_history outlives it. The error says why it cannot listen.
  static Result<std::unique_ptr<StopServer>> start(const Access& access,
                                                   ManualControl::OpenBus open_bus,
                                                   const FrameHistory& frame_history,
                                                   std::function<void()> release_hold);
  StopServer(const StopServer&) = delete;
  StopServer& operator=(const StopServer&) = delete;
  ~StopServer();

  int port() const { return listener_->port(); }

 private:
  StopServer(Access access, ManualControl::OpenBus open_bus, const FrameHistory& frame_history,
             std::function<void()> release_hold);
  struct PendingStop {
    StopListener::Answer answer;
    std::string allowed_origin;
  };

  void take(const httplib::Request& request, const StopListener::Answer& answer);
  void run();
  void stop(const std::vector<PendingStop>& pending);
  using Clock = std::chrono::steady_clock;
  using Masters = std::vector<can_client::Master>;
  /// Each of these returns the error; empty: done.
  std::string disarm(const std::vector<std::uint8_t>& nodes);
  std::string send_disarm(Masters& unconfirmed);
  std::string send_until(const hal::CanFrame& frame, Clock::time_point deadline);
  std::string open_bus();
  /// Removes those whose node reports that it is disarmed.
  void receive_until(Masters& unconfirmed, Clock::time_point end, bool also_by_status);
  void maintain_bus();

  Access access_;
  ManualControl::OpenBus new_bus_;
  const FrameHistory* frame_history_;
  std::function<void()> release_hold_;
  std::unique_ptr<hal::CanBus> bus_;  ///< used by the thread
  Clock::time_point next_try_{};
  std::mutex mutex_;
  std::condition_variable woken_;
  std::vector<PendingStop> pending_;
  bool ending_ = false;
  std::unique_ptr<StopListener> listener_;
  std::thread thread_;
};

}  // namespace supercoil::operating
