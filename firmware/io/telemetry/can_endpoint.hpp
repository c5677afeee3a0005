// A board on its bus: telemetry out, commands in.
#pragma once

#include "telemetry/commands.hpp"
#include "telemetry/publisher.hpp"
#include "telemetry/run_settings.hpp"
#include "telemetry/trajectory_frames.hpp"
#include "telemetry/tuning_frames.hpp"

namespace supercoil::telemetry {

/// Identifiers of all frames that a board listens to, for the bus's receive filters.
std::vector<std::uint16_t> received_ids(const CanSettings& settings, std::size_t channels);

/// Used by one thread: on a board the telemetry thread, never the loop's; in a simulation the
/// runner, between two ticks. Nothing blocks.
class CanEndpoint {
 public:
  /// board: the settings that the loop was made with. Loop and bus must outlive the endpoint.
  CanEndpoint(const CanSettings& settings, const BoardSettings& board, Loop& loop, hal::CanBus& bus,
              Leases::Random random);

  /// The newest row of a channel.
  void offer(const Row& row) {
    loop_runs_ = true;
    publisher_.offer(row);
  }
  /// The loop's answers to commands with Source::can, in their order.
  void answer(const Answer& answer);
  /// Handles received frames, sends what is due, and reports the state of the bus to the loop.
  void poll(hal::Time now);

  const Publisher& publisher() const { return publisher_; }

 private:
  void receive(hal::Time now);
  void send_boot(hal::Time now);
  std::optional<hal::CanFrame> muscle_answer(const hal::CanFrame& frame) const;
  /// Whether only this board's nodes send such a frame: the bus never returns a board's own frames.
  bool is_own(const hal::CanFrame& frame) const;

  /// Frames taken in one poll: more than a full bus brings within a telemetry thread's round.
  static constexpr int max_batch = 256;
  /// Longer than two heartbeat periods at the slowest rate.
  static constexpr hal::Duration conflict_lasts = std::chrono::milliseconds(2500);

  Loop* loop_;
  hal::CanBus* bus_;
  Publisher publisher_;
  Leases leases_;
  Commands commands_;
  RunSettings settings_;
  TuningFrames tuning_;
  TrajectoryFrames trajectory_;
  can::Node first_node_;
  hal::Time conflict_until_{};
  hal::Time next_boot_{};
  std::size_t boot_channel_ = 0;  ///< the channel whose Boot is sent next
  bool loop_runs_ = false;        ///< a row has come since the last Boot
};

}  // namespace supercoil::telemetry
