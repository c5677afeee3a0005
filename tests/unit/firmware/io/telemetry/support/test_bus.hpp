// A bus that keeps what is sent to it.
#pragma once

#include <deque>
#include <vector>

#include "supercoil/hal/can_bus.hpp"

namespace supercoil::test {

class TestBus final : public hal::CanBus {
 public:
  hal::Status send(const hal::CanFrame& frame) override {
    if (answer == hal::Status::ok) sent.push_back(frame);
    return answer;
  }
  hal::Status receive(hal::CanFrame& frame) override {
    if (inbox.empty()) return hal::Status::not_ready;
    frame = inbox.front();
    inbox.pop_front();
    return hal::Status::ok;
  }
  hal::CanState state() const override { return link; }

  hal::Status answer = hal::Status::ok;
  hal::CanState link = hal::CanState::active;
  std::vector<hal::CanFrame> sent;
  std::deque<hal::CanFrame> inbox;
};

}  // namespace supercoil::test
