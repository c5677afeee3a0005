// The bus's recent frames, for all readers.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/can_bus.hpp"

namespace supercoil::operating {

/// Whether a frame is so much earlier than the one received before that its clock must have been
/// set back, or the source restarted. Frames of one source differ by less.
constexpr bool is_restart(hal::Time before, hal::Time next) {
  return next + std::chrono::seconds(1) < before;
}

/// How busy the bus is.
struct BusFigures {
  double load = 0.0;  ///< fraction of the bus's time, at worst stuffing, over the last second
  double frames_per_s = 0.0;
  double foreign_per_s = 0.0;  ///< of these, frames outside the protocol
};

/// Safe from any thread.
class FrameHistory {
 public:
  /// keep_s: older frames are dropped, and all of them when the source restarts; 0: none are.
  /// bit_rate: of the bus, to compute its load.
  FrameHistory(double keep_s, double bit_rate)
      : keep_(hal::duration_from(keep_s)), bit_rate_(bit_rate) {}

  void add(const std::vector<hal::CanFrame>& frames);

  struct Part {
    std::vector<hal::CanFrame> frames;
    std::uint64_t next = 0;  ///< where the next part begins
  };
  /// Frames since `from`; only `next` when `from` is the present end.
  Part since(std::uint64_t from) const;
  std::uint64_t end() const;
  /// Frames between two times of the bus; a negative from is relative to the newest frame.
  std::vector<hal::CanFrame> between(hal::Time from, hal::Time to) const;
  /// Over the second before the newest frame; all 0 while the source is lost.
  BusFigures figures() const;
  /// supercoil nodes that have sent a message, in order.
  std::vector<std::uint8_t> nodes() const;

  /// FirstCause of the last fault that a node reported; empty: none was received, or it was reset.
  std::optional<hal::CanFrame> first_cause(std::uint8_t node) const;

  /// Why the source is lost; empty: it is connected.
  void set_lost(const std::string& reason);
  std::string lost() const;

 private:
  hal::Duration keep_;
  double bit_rate_;
  mutable std::mutex mutex_;
  std::deque<hal::CanFrame> frames_;
  std::uint64_t dropped_ = 0;
  std::uint64_t nodes_ = 0;  ///< one bit for each
  std::map<std::uint8_t, hal::CanFrame> first_causes_;
  std::string lost_;
};

}  // namespace supercoil::operating
