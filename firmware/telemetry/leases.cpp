#include "telemetry/leases.hpp"

#include "telemetry/e2e.hpp"

namespace supercoil::telemetry {

Leases::Leases(double lease_s, std::size_t channels, std::uint32_t seed)
    : lasts_(hal::duration_from(lease_s)), leases_(channels), random_(seed) {}

Leases::Lease& Leases::lease_now(std::uint8_t channel, hal::Time now) {
  Lease& lease = leases_[channel];
  if (!live(lease, now)) lease.session = 0;
  return lease;
}

/// A claim whose answer was lost is repeated, and granted again while nothing has come since.
Refusal Leases::claim(std::uint8_t channel, std::uint16_t claimed_as, std::uint8_t counter,
                      hal::Time now) {
  Lease& lease = lease_now(channel, now);
  if (lease.session != 0 && claimed_as == lease.session)
    return check(channel, claimed_as, counter, now);
  const bool again = lease.session != 0 && !lease.used && lease.claimed_as == claimed_as;
  if (lease.session != 0 && !again) return Refusal::not_yours;
  if (!again) lease.session = lease.last_session = new_session(lease);
  lease.claimed_as = claimed_as;
  lease.used = false;
  lease.counter = counter;
  lease.last = now;
  return Refusal::none;
}

/// A sequence that was broken goes on from where it is now.
Refusal Leases::check(std::uint8_t channel, std::uint16_t session, std::uint8_t counter,
                      hal::Time now) {
  Lease& lease = lease_now(channel, now);
  if (lease.session == 0) return Refusal::no_lease;
  if (session != lease.session) return Refusal::not_yours;
  const bool next = e2e::follows(counter, lease.counter);
  lease.counter = counter;
  if (!next) return Refusal::wrong_counter;
  lease.used = true;
  lease.last = now;
  return Refusal::none;
}

std::uint16_t Leases::new_session(const Lease& lease) {
  std::uint16_t session = 0;
  // The engine's own numbers are the same everywhere; a distribution's are not.
  while (session == 0 || session == lease.last_session)
    session = static_cast<std::uint16_t>(random_());
  return session;
}

}  // namespace supercoil::telemetry
