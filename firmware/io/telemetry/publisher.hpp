// Sends the board's own frames, in order and on time, through a bounded queue onto the bus.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <boost/circular_buffer.hpp>

#include "supercoil/hal/can_bus.hpp"

#include "loop/loop.hpp"
#include "telemetry/joint_frame.hpp"
#include "telemetry/schedule.hpp"

namespace supercoil::telemetry {

/// Used by one thread, never the loop's. Nothing blocks, and only set_rates() allocates after
/// construction.
/// Frames that the bus does not take wait for the next poll; when the queue is full, the oldest is
/// dropped and counted. When the bus is lost, waiting frames are dropped: they are outdated when it
/// is back.
class Publisher {
 public:
  /// channels: the board's. timing and bus outlive the publisher.
  Publisher(const CanSettings& settings, const std::vector<ChannelSettings>& channels,
            LoopTiming& timing, hal::CanBus& bus);

  /// The newest row of its channel. A change of its fault is sent before all that waits.
  void offer(const Row& row);
  /// Sends what is due and what waits. leased: whether a channel is commanded over CAN. No message
  /// is sent twice from the same row: when the loop stops, the board falls silent.
  template <class Leased>
  void poll(hal::Time now, const Leased& leased) {
    flush();
    schedule_.due(now, [&](std::uint8_t channel, Message message) {
      publish(channel, message, leased(channel));
    });
    flush();
  }
  /// Sends an answer before the messages that wait, so that an overloaded bus can be commanded.
  void send(const hal::CanFrame& frame);
  /// The rates of each channel.
  const std::vector<Rates>& rates_Hz() const { return schedule_.rates_Hz(); }
  /// Takes effect at once; all messages get new places in their periods.
  void set_rates(const std::vector<Rates>& rates_Hz) { schedule_ = Schedule(rates_Hz); }

  /// Frames dropped from a full queue or lost with the bus.
  std::uint32_t dropped() const { return dropped_; }
  std::size_t waiting() const { return emergencies_.size() + answers_.size() + messages_.size(); }

 private:
  struct Channel {
    Row row{};
    bool known = false;                            ///< there was a row
    std::array<std::int64_t, messages> sent_ns{};  ///< time of the row that each was made from
    MultiplexedValues multiplexed;
    std::uint8_t parameter = 0;             ///< the last one sent in Estimate
    std::uint8_t counter = 0;               ///< of Status
    std::uint8_t joint_part = 0;            ///< the next one to send in Joint
    control::KnownParameters muscle{};      ///< what θ alone cannot tell
    control::Lever lever;                   ///< of its joint
    std::optional<std::size_t> antagonist;  ///< channel of the muscle that turns it back
  };

  using Queue = boost::circular_buffer<hal::CanFrame>;

  void push(Queue& queue, const hal::CanFrame& frame);
  void publish(std::uint8_t index, Message message, bool leased);
  hal::CanFrame frame_of(can::Node node, Channel& channel, Message message, bool leased);
  hal::CanFrame next_of_joint(can::Node node, Channel& agonist) const;
  BoardTiming take_timing();
  void flush();

  can::Node first_node_;
  std::vector<Channel> channels_;
  Schedule schedule_;
  LoopTiming* timing_;
  hal::CanBus* bus_;
  // In the order in which they go out.
  Queue emergencies_;
  Queue answers_;
  Queue messages_;
  std::uint32_t dropped_ = 0;
};

}  // namespace supercoil::telemetry
