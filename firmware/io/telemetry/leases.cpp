#include "telemetry/leases.hpp"

#include <utility>

#include "can/e2e.hpp"

namespace supercoil::telemetry {

Leases::Leases(double lease_s, std::size_t channels, Random random)
    : lasts_(hal::duration_from(lease_s)), leases_(channels), random_(std::move(random)) {}

Leases::Lease& Leases::lease_now(std::uint8_t channel, hal::Time now) {
  Lease& lease = leases_[channel];
  if (!live(lease, now)) lease.session = 0;
  return lease;
}

/// A claim is repeated if its answer was lost, and is granted if no command has come since. All who
/// claim meanwhile get the same nonce; the first to repeat it gets the lease.
Refusal Leases::claim(std::uint8_t channel, std::uint16_t claimed_as, double nonce,
                      std::uint8_t counter, hal::Time now) {
  Lease& lease = lease_now(channel, now);
  const bool again = !lease.used && lease.claimed_as == claimed_as;
  if (lease.session != 0 && !again) return Refusal::not_lease_holder;
  if (lease.nonce == 0 || now - lease.nonce_from > lasts_) {
    lease.nonce = random_except(lease.last_nonce);
    lease.last_nonce = lease.nonce;
    lease.nonce_from = now;
    return Refusal::claim_again;
  }
  if (nonce != lease.nonce) return Refusal::claim_again;
  lease.nonce = 0;
  if (lease.used) lease.replaced = lease.last_session;
  lease.session = lease.last_session = random_except(lease.last_session);
  lease.claimed_as = claimed_as;
  lease.used = false;
  lease.counter = counter;
  lease.last = now;
  return Refusal::none;
}

/// A broken sequence goes on from the current counter.
Refusal Leases::check(std::uint8_t channel, std::uint16_t session, std::uint8_t counter,
                      hal::Time now) {
  Lease& lease = lease_now(channel, now);
  if (lease.session == 0) return Refusal::no_lease;
  if (session != lease.session) return Refusal::not_lease_holder;
  const bool next = can::e2e::follows(counter, lease.counter);
  lease.counter = counter;
  if (!next) return Refusal::wrong_counter;
  lease.used = true;
  lease.last = now;
  return Refusal::none;
}

std::uint16_t Leases::random_except(std::uint16_t last) {
  std::uint16_t number = 0;
  while (number == 0 || number == last)
    number = static_cast<std::uint16_t>(random_());
  return number;
}

}  // namespace supercoil::telemetry
