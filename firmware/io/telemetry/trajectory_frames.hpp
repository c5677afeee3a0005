// Receives trajectories over CAN, and starts them on several boards at once.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "can/generated/messages.hpp"
#include "can/nodes.hpp"
#include "loop/loop.hpp"
#include "telemetry/bus_clock.hpp"
#include "telemetry/leases.hpp"
#include "telemetry/unanswered.hpp"

namespace supercoil::telemetry {

/// Identifier of the one Sync that all boards of a bus hear.
inline constexpr std::uint16_t sync_id = can::id_of(can::message::sync, 1);

/// Values of Trajectory.answers, and of Play.when.
enum Answers : std::uint8_t { nothing, answers_knot, answers_play };
/// When a trajectory starts: on receipt, at a Sync, or not; the last only asks for its state.
enum When : std::uint8_t { at_once, at_sync, never };

/// Whether TrajectoryFrames, not Commands, answers it.
constexpr bool is_of_trajectory(Verb verb) {
  return verb == Verb::knot || verb == Verb::start;
}

/// Neither sends nor receives. Knots and Play need the channel's lease, as commands do, and are
/// answered when the loop has done them. Sync needs no lease: it moves nothing by itself.
class TrajectoryFrames {
 public:
  /// leases and loop must outlive it. first_node: that of the board's first channel.
  TrajectoryFrames(can::Node first_node, Leases& leases, Loop& loop);

  /// The result of a frame. All empty: the frame is not about trajectories.
  struct Taken {
    std::optional<std::uint8_t> damaged;  ///< the channel whose frame was damaged
    std::optional<hal::CanFrame> answer;
  };
  /// Any frame of the bus, in the order received.
  Taken take(const hal::CanFrame& frame, hal::Time now);

  /// The frame that answers a trajectory command; empty: the command did not come over CAN.
  std::optional<hal::CanFrame> answered(const Answer& answer);
  /// The next frame of a channel whose playback state changed; empty: none has changed.
  std::optional<hal::CanFrame> changed_playback();

 private:
  /// The part of a frame that its answer repeats.
  struct Header {
    std::uint8_t channel;
    std::uint8_t answers;
    std::uint8_t counter;
    std::uint16_t session;
  };
  struct Start {
    Header header;
    std::uint8_t sync;
    double after_s;
  };
  struct Channel {
    std::optional<Start> start;            ///< waits for its Sync
    std::optional<BusClock::Sync> anchor;  ///< the Sync of the last start
    PlaybackState reported = PlaybackState::empty;
  };

  Taken take_knot(std::uint8_t channel, const hal::CanFrame& frame, hal::Time now);
  Taken take_play(std::uint8_t channel, const hal::CanFrame& frame, hal::Time now);
  void take_sync(const hal::CanFrame& frame, hal::Time now);
  /// Empty: the loop has taken it, and will answer.
  std::optional<hal::CanFrame> hand_on(const Header& header, Command command);
  std::optional<hal::CanFrame> start(const Start& start, const BusClock::Sync& sync);
  hal::CanFrame trajectory_frame(const Header& header, Refusal refusal) const;

  can::Node first_node_;
  Leases* leases_;
  Loop* loop_;
  BusClock clock_;
  std::vector<Channel> channels_;
  Unanswered<Header> waiting_;
};

}  // namespace supercoil::telemetry
