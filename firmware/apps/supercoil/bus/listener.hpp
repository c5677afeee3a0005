// Reads the bus.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "supercoil/hal/can_bus.hpp"

#include "apps/supercoil/bus/recent.hpp"

namespace supercoil::operating {

/// A thread that puts received frames into `frame_history` until it is destroyed.
class Listener {
 public:
  Listener(std::unique_ptr<hal::CanBus> bus, FrameHistory& frame_history);
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

 private:
  void run();

  std::unique_ptr<hal::CanBus> bus_;
  FrameHistory* frame_history_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace supercoil::operating
