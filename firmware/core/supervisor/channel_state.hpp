// The one place that decides whether a channel may be hot.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "supervisor/fault.hpp"

namespace supercoil {

/// A channel's state, and how each is left:
///   disarmed  cold, enable low. To armed: arm().
///   armed     cold, enable high. To active: activate(). To disarmed: disarm(none).
///   active    may be hot. To armed: rest(). To disarmed: disarm(none).
///   fault     cold, enable low. To disarmed: reset(), a rising edge of the reset command, after
///             the cause is gone.
/// From every state disarm(cause) leads to fault. It boots disarmed. Nothing restarts by itself.
enum class State : std::uint8_t { disarmed, armed, active, fault };

inline constexpr std::array<std::string_view, 4> state_names{"disarmed", "armed", "active",
                                                             "fault"};
constexpr std::string_view name(State state) {
  return state_names[static_cast<std::size_t>(state)];
}

/// Why a command was not obeyed.
enum class Refusal : std::uint8_t {
  none = 0,
  wrong_state = 1,     ///< this state does not allow it
  cause_persists = 2,  ///< reset: a detector still trips
  no_edge = 3,         ///< reset: requested already, in this tick or the last one
  not_ready = 4,       ///< blocked by the self-test, a fault of the board or a missing reading
  busy = 5,            ///< a probe, identification or calibration is under way
  out_of_range = 6,    ///< the command's value
  no_such_channel = 7,
  not_lease_holder = 8,    ///< over CAN: another master holds the lease
  no_lease = 9,            ///< over CAN: no master holds the lease; claim it first
  wrong_counter = 10,      ///< over CAN: repeated, or too many commands were lost before it
  queue_full = 11,         ///< more commands than a tick can take
  claim_again = 12,        ///< over CAN: the lease is free; claim it with the number in the answer
  protocol_mismatch = 13,  ///< over CAN: another version of the protocol
  unsuitable = 14,  ///< an invalid prepared controller or estimator; a joint's or follower's scale
  infeasible = 15,  ///< a knot: the muscle cannot move there that fast, or would have to be cooled
};

inline constexpr std::array<std::string_view, 16> refusal_names{
    "none",          "wrong_state",  "cause_persists",  "no_edge",           "not_ready",
    "busy",          "out_of_range", "no_such_channel", "not_lease_holder",  "no_lease",
    "wrong_counter", "queue_full",   "claim_again",     "protocol_mismatch", "unsuitable",
    "infeasible"};
constexpr std::string_view name(Refusal refusal) {
  return refusal_names[static_cast<std::size_t>(refusal)];
}

/// State and first cause of one channel. Every way of making it safe is disarm().
class ChannelState {
 public:
  State state() const { return state_; }
  /// The cause that first led to `fault`; later ones do not replace it. None in every other state.
  Fault first_cause() const { return first_cause_; }
  /// The level that the enable line must have now.
  bool enable() const { return state_ == State::armed || state_ == State::active; }
  /// Whether any duty may be applied for the controller.
  bool may_heat() const { return state_ == State::active; }

  /// Makes the channel safe. Fault::none: an ordinary stop, which does not leave `fault`.
  void disarm(Fault cause) {
    if (state_ == State::fault) return;  // the first cause is kept
    first_cause_ = cause;
    state_ = cause == Fault::none ? State::disarmed : State::fault;
  }

  Refusal arm() { return move(State::disarmed, State::armed); }
  Refusal activate() { return move(State::armed, State::active); }
  Refusal rest() { return move(State::active, State::armed); }

  /// Once a tick: the level of the reset command, and whether any detector still trips. Only a
  /// rising edge resets: a level that is stuck high, or was high at boot, does nothing.
  Refusal reset(bool level, bool cause_persists) {
    const bool edge = level && !last_reset_;
    last_reset_ = level;
    if (!edge) return Refusal::no_edge;
    if (state_ != State::fault) return Refusal::wrong_state;
    if (cause_persists) return Refusal::cause_persists;
    state_ = State::disarmed;
    first_cause_ = Fault::none;
    return Refusal::none;
  }

 private:
  Refusal move(State from, State to) {
    if (state_ != from) return Refusal::wrong_state;
    state_ = to;
    return Refusal::none;
  }

  State state_ = State::disarmed;
  Fault first_cause_ = Fault::none;
  bool last_reset_ = true;  ///< a level that is high at boot is not an edge
};

}  // namespace supercoil
