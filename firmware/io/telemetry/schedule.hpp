// When each message of each channel is sent, and how much of the bus that takes.
#pragma once

#include <algorithm>
#include <vector>

#include "supercoil/hal/clock.hpp"

#include "telemetry/settings.hpp"

namespace supercoil::telemetry {

/// Bits on the wire of a frame with an 11-bit identifier and this many bytes, with the max number
/// of stuffed bits and the pause before the next frame (Davis, Burns, Bril, Lukkien: Controller
/// Area Network schedulability analysis, 2007, equation 1, with 3 bits of pause).
constexpr int max_bits(int bytes) {
  constexpr int exposed = 34;  // bits of a frame without data that may need stuffing
  const int stuffed = (exposed + 8 * bytes - 1) / 4;
  return exposed + 8 * bytes + 13 + stuffed;
}

/// The fraction of the bus that periodic messages and Boot take: 1 is all of it. Commands, their
/// answers and emergencies come on top.
double bus_load(const std::vector<Rates>& of_channels_Hz, double bit_rate);
/// The same with the configured rates.
double bus_load(const CanSettings& can, const std::vector<ChannelSettings>& channels);

/// Each message of each channel has its own place within its period, evenly spread, so that frames
/// do not come in bursts. Missed messages are not made up for.
class Schedule {
 public:
  /// When one message of one channel is due.
  struct Slot {
    std::uint8_t channel;
    Message message;
    hal::Duration period;
    hal::Time next;  ///< before the first due(): its offset within the period
  };

  explicit Schedule(std::vector<Rates> of_channels_Hz);

  const std::vector<Rates>& rates_Hz() const { return rates_Hz_; }

  /// Calls send(channel, message) for all that is due. The first call sets the start.
  template <class Send>
  void due(hal::Time now, const Send& send) {
    if (!started_) start(now);
    if (now < earliest_) return;
    earliest_ = hal::Time::max();
    for (Slot& slot : slots_) {
      if (slot.next <= now) {
        send(slot.channel, slot.message);
        slot.next += slot.period * ((now - slot.next) / slot.period + 1);
      }
      earliest_ = std::min(earliest_, slot.next);
    }
  }

 private:
  void start(hal::Time now);

  std::vector<Rates> rates_Hz_;
  std::vector<Slot> slots_;
  hal::Time earliest_{};
  bool started_ = false;
};

}  // namespace supercoil::telemetry
