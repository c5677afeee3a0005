// Which master may command a channel over CAN.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "supercoil/hal/clock.hpp"

#include "supervisor/channel_state.hpp"

namespace supercoil::telemetry {

/// A lease a channel. A claim is answered with a nonce; the claim that repeats it is granted with a
/// session, which every command must carry. Both are random numbers of the board's, and a nonce is
/// good for one claim within lease_s: recorded frames get no lease. A lease ends when it is
/// released or unused for lease_s; keeping it under its session is for where there is nothing else
/// to command. A session is never granted twice in a row, so frames of an earlier one are refused.
/// This guards against mistakes, faults and recordings, not against somebody who means harm:
/// whoever can send can also claim.
class Leases {
 public:
  /// 32 bits that nobody can predict: on a board from a source of true randomness.
  using Random = std::function<std::uint32_t()>;
  Leases(double lease_s, std::size_t channels, Random random);

  std::size_t channels() const { return leases_.size(); }
  bool held(std::uint8_t channel, hal::Time now) const { return live(leases_[channel], now); }

  /// claimed_as: what the claim carries as its session; nonce: what it repeats, 0: none yet.
  /// Granted: session(). claim_again: with nonce().
  Refusal claim(std::uint8_t channel, std::uint16_t claimed_as, double nonce, std::uint8_t counter,
                hal::Time now);
  std::uint16_t nonce(std::uint8_t channel) const { return leases_[channel].nonce; }
  /// Of the last claim that was granted, 0: nobody's.
  std::uint16_t session(std::uint8_t channel) const { return leases_[channel].session; }
  /// Of the master that commanded under the lease before this one; 0: nobody's.
  std::uint16_t replaced(std::uint8_t channel) const { return leases_[channel].replaced; }
  void release(std::uint8_t channel) { leases_[channel].session = 0; }

  /// Whether a frame with this session and counter is its holder's next one. wrong_counter: the
  /// frame was repeated or too many were lost; the next one is obeyed.
  Refusal check(std::uint8_t channel, std::uint16_t session, std::uint8_t counter, hal::Time now);

 private:
  struct Lease {
    std::uint16_t session = 0;  ///< 0: nobody's
    std::uint16_t last_session = 0;
    std::uint16_t replaced = 0;  ///< the last session before this one that was used; 0: none
    std::uint16_t claimed_as = 0;
    std::uint16_t nonce = 0;  ///< that is good for a claim; 0: none
    std::uint16_t last_nonce = 0;
    bool used = false;         ///< a command came since the claim
    std::uint8_t counter = 0;  ///< of the last frame
    hal::Time last{};
    hal::Time nonce_from{};
  };

  bool live(const Lease& lease, hal::Time now) const {
    return lease.session != 0 && now - lease.last <= lasts_;
  }
  Lease& lease_now(std::uint8_t channel, hal::Time now);
  /// Neither 0 nor this one.
  std::uint16_t random_except(std::uint16_t last);

  hal::Duration lasts_;
  std::vector<Lease> leases_;
  Random random_;
};

}  // namespace supercoil::telemetry
