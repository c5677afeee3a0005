// Which master may command a channel over CAN.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "supercoil/hal/clock.hpp"

#include "supervisor/channel_state.hpp"

namespace supercoil::telemetry {

/// One lease per channel. The board answers a claim with a nonce, and the claim that repeats it
/// with a session, which every command must carry. Both are random numbers that the board draws,
/// and a nonce is good for one claim within lease_s: recorded frames get no lease. A lease ends
/// when it is released or unused for lease_s; a master that has nothing to command keeps it by a
/// claim under its session. A session is never granted twice in a row, so frames of an earlier one
/// are refused. This guards against mistakes, faults and recordings, not against an attacker:
/// whoever can send can also claim.
class Leases {
 public:
  /// 32 bits that nobody can predict: on a board from a source of true randomness.
  using Random = std::function<std::uint32_t()>;
  Leases(double lease_s, std::size_t channels, Random random);

  std::size_t channels() const { return leases_.size(); }
  /// Whether a master holds the lease at this time.
  bool held(std::uint8_t channel, hal::Time now) const { return live(leases_[channel], now); }

  /// claimed_as: the session field of the claim; nonce: what the claim repeats, 0: none yet. When
  /// granted, session() is the session; after claim_again, nonce() is the nonce.
  Refusal claim(std::uint8_t channel, std::uint16_t claimed_as, double nonce, std::uint8_t counter,
                hal::Time now);
  /// After claim_again: what the next claim must repeat.
  std::uint16_t nonce(std::uint8_t channel) const { return leases_[channel].nonce; }
  /// The session of the last granted claim; 0: nobody has the lease.
  std::uint16_t session(std::uint8_t channel) const { return leases_[channel].session; }
  /// The session of the master that commanded under the previous lease; 0: none.
  std::uint16_t replaced(std::uint8_t channel) const { return leases_[channel].replaced; }
  /// Ends the lease at once; any master may claim it.
  void release(std::uint8_t channel) { leases_[channel].session = 0; }

  /// Whether a frame with this session and counter is the lease holder's next one. wrong_counter:
  /// the frame was repeated or too many were lost; the next one is obeyed.
  Refusal check(std::uint8_t channel, std::uint16_t session, std::uint8_t counter, hal::Time now);

 private:
  struct Lease {
    std::uint16_t session = 0;  ///< 0: nobody has the lease
    std::uint16_t last_session = 0;
    std::uint16_t replaced = 0;  ///< the last session before this one that was used; 0: none
    std::uint16_t claimed_as = 0;
    std::uint16_t nonce = 0;  ///< valid for one claim; 0: none
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
  /// Neither 0 nor `last`.
  std::uint16_t random_except(std::uint16_t last);

  hal::Duration lasts_;
  std::vector<Lease> leases_;
  Random random_;
};

}  // namespace supercoil::telemetry
