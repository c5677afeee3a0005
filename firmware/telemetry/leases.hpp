// Who may command a channel over CAN.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "supercoil/hal/clock.hpp"

#include "supervisor/channel_state.hpp"

namespace supercoil::telemetry {

/// A lease a channel. It is claimed, and granted with a session: a random number that every command
/// must carry. It ends when it is released or unused for lease_s; claiming it again under its
/// session keeps it, where there is nothing else to command. A session is never granted twice in a
/// row, so frames of an earlier one are refused. This guards against mistakes and faults, not
/// against somebody who means harm: whoever can send can also claim.
class Leases {
 public:
  /// seed: of the sessions; on a board from a source of true randomness.
  Leases(double lease_s, std::size_t channels, std::uint32_t seed);

  std::size_t channels() const { return leases_.size(); }
  bool held(std::uint8_t channel, hal::Time now) const { return live(leases_[channel], now); }

  /// claimed_as: what the claim carries as its session. Granted: session().
  Refusal claim(std::uint8_t channel, std::uint16_t claimed_as, std::uint8_t counter,
                hal::Time now);
  /// Of the last claim that was granted, 0: nobody's.
  std::uint16_t session(std::uint8_t channel) const { return leases_[channel].session; }
  void release(std::uint8_t channel) { leases_[channel].session = 0; }

  /// Whether a frame with this session and counter is its holder's next one. wrong_counter: the
  /// frame was repeated or too many were lost; the next one is obeyed.
  Refusal check(std::uint8_t channel, std::uint16_t session, std::uint8_t counter, hal::Time now);

 private:
  struct Lease {
    std::uint16_t session = 0;  ///< 0: nobody's
    std::uint16_t last_session = 0;
    std::uint16_t claimed_as = 0;
    bool used = false;         ///< a command came since the claim
    std::uint8_t counter = 0;  ///< of the last frame
    hal::Time last{};
  };

  bool live(const Lease& lease, hal::Time now) const {
    return lease.session != 0 && now - lease.last <= lasts_;
  }
  Lease& lease_now(std::uint8_t channel, hal::Time now);
  std::uint16_t new_session(const Lease& lease);

  hal::Duration lasts_;
  std::vector<Lease> leases_;
  std::mt19937 random_;
};

}  // namespace supercoil::telemetry
