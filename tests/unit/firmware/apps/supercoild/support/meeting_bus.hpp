// A CAN bus that connects the daemon's telemetry thread with a test.
#pragma once

#include <deque>
#include <mutex>
#include <vector>

#include "supercoil/hal/can_bus.hpp"

namespace supercoil::test {

class MeetingBus final : public hal::CanBus {
 public:
  hal::Status send(const hal::CanFrame& frame) override {
    const std::lock_guard lock(mutex_);
    sent_.push_back(frame);
    return hal::Status::ok;
  }
  hal::Status receive(hal::CanFrame& frame) override {
    const std::lock_guard lock(mutex_);
    if (incoming_.empty()) return hal::Status::not_ready;
    frame = incoming_.front();
    incoming_.pop_front();
    return hal::Status::ok;
  }
  hal::CanState state() const override { return hal::CanState::active; }

  /// For the test.
  void deliver(const hal::CanFrame& frame) {
    const std::lock_guard lock(mutex_);
    incoming_.push_back(frame);
  }
  /// All frames that the board has sent with this identifier.
  std::vector<hal::CanFrame> sent(std::uint16_t id) const {
    const std::lock_guard lock(mutex_);
    std::vector<hal::CanFrame> found;
    for (const hal::CanFrame& frame : sent_) {
      if (frame.id == id) found.push_back(frame);
    }
    return found;
  }

 private:
  mutable std::mutex mutex_;
  std::deque<hal::CanFrame> incoming_;
  std::vector<hal::CanFrame> sent_;
};

}  // namespace supercoil::test
