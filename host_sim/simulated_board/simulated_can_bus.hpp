// A board's connection to a CAN bus with other boards, or with only a test or a log.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>

#include "supercoil/hal/can_bus.hpp"

#include "telemetry/schedule.hpp"

namespace supercoil::host_sim {

/// What boards on one bus share.
struct CanWire {
  hal::Time free_from{};  ///< in the boards' common time
};

/// Frames take the longest time that they can take on a real bus, and the queue is as long as the
/// kernel's: a frame is sent, and heard, when its time has come. Boards get the bus in the order in
/// which they ask, not by identifiers.
class SimulatedCanBus final : public hal::CanBus {
 public:
  /// clock: stamps the frames; must outlive the bus.
  SimulatedCanBus(const hal::Clock& clock, double bit_rate) : clock_(&clock), bit_rate_(bit_rate) {}
  SimulatedCanBus(const SimulatedCanBus&) = delete;
  SimulatedCanBus& operator=(const SimulatedCanBus&) = delete;

  /// Call before the first frame. start: the board's clock at the common time 0. The wire must
  /// outlive the bus.
  void share(CanWire& wire, hal::Time start) {
    wire_ = &wire;
    start_ = start;
  }

  hal::Status send(const hal::CanFrame& frame) override {
    if (link == hal::CanState::down) return hal::Status::gone;
    if (link == hal::CanState::bus_off) return hal::Status::io_error;
    const hal::Time now = clock_->now();
    while (!ends_.empty() && ends_.front() <= now)
      ends_.pop_front();
    if (refuses || ends_.size() >= queue) return hal::Status::busy;
    const hal::Time begins = std::max(now, wire_->free_from + start_);
    const double frame_s = telemetry::max_bits(frame.length) / bit_rate_;
    ends_.push_back(begins + hal::duration_from(frame_s));
    wire_->free_from = ends_.back() - start_;
    hal::CanFrame received = frame;
    received.received = ends_.back();
    listener(received);
    return hal::Status::ok;
  }
  hal::Status receive(hal::CanFrame& frame) override {
    if (link != hal::CanState::active && link != hal::CanState::error_passive)
      return hal::Status::io_error;
    if (inbox_.empty()) return hal::Status::not_ready;
    frame = inbox_.front();
    inbox_.pop_front();
    return hal::Status::ok;
  }
  hal::CanState state() const override { return link; }

  /// A frame from another node. It comes now unless it has a time; it is lost when as many wait as
  /// in the kernel's buffer.
  void deliver(const hal::CanFrame& frame) {
    if (inbox_.size() >= inbox) return;
    inbox_.push_back(frame);
    if (frame.received == hal::Time{}) inbox_.back().received = clock_->now();
  }

  /// Hears every frame of the board; `received` is when its last bit was on the wire.
  std::function<void(const hal::CanFrame&)> listener = [](const hal::CanFrame&) {};
  hal::CanState link = hal::CanState::active;
  bool refuses = false;  ///< others keep the bus busy

 private:
  /// Default txqueuelen of a Linux CAN interface.
  static constexpr std::size_t queue = 10;
  static constexpr std::size_t inbox = 1024;

  const hal::Clock* clock_;
  double bit_rate_;
  CanWire own_;
  CanWire* wire_ = &own_;
  hal::Time start_{};
  std::deque<hal::Time> ends_;  ///< of frames in transit
  std::deque<hal::CanFrame> inbox_;
};

}  // namespace supercoil::host_sim
