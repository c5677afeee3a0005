#include "telemetry/commands.hpp"

#include <supercoil.h>

#include "telemetry/e2e.hpp"
#include "telemetry/opcodes.hpp"
#include "telemetry/pack.hpp"

namespace supercoil::telemetry {

namespace {

/// The DBC describes node 1.
constexpr int command_base = SUPERCOIL_COMMAND_FRAME_ID - 1;

}  // namespace

std::vector<std::uint16_t> command_ids(const CanSettings& settings, std::size_t channels) {
  std::vector<std::uint16_t> ids;
  const int first = command_base + settings.first_node;
  for (int i = 0; i < static_cast<int>(channels); ++i)
    ids.push_back(static_cast<std::uint16_t>(first + i));
  return ids;
}

Commands::Commands(const CanSettings& settings, std::size_t channels, std::uint32_t seed)
    : first_node_(settings.first_node),
      lease_(hal::duration_from(settings.lease_s)),
      leases_(channels),
      random_(seed) {}

Commands::Taken Commands::take(const hal::CanFrame& frame, hal::Time now) {
  const int channel = frame.id - command_base - first_node_;
  if (channel < 0 || channel >= static_cast<int>(leases_.size())) return {};
  Taken taken;
  const auto index = static_cast<std::uint8_t>(channel);
  if (!e2e::intact(frame, SUPERCOIL_COMMAND_LENGTH)) {
    taken.damaged = index;
    return taken;
  }
  supercoil_command_t m{};
  supercoil_command_unpack(&m, frame.data.data(), frame.length);
  const Asked asked{index, m.opcode, m.counter, m.session};
  Lease& lease = leases_[index];
  if (!live(lease, now)) lease.session = 0;

  // From everybody, whatever is wrong with lease and counter.
  const bool stop = m.opcode == static_cast<std::uint8_t>(Verb::disarm) && m.value == 0.0F;
  bool damaged = false;
  const Refusal checked = check(lease, asked, m.value, now, damaged);
  if (damaged && !stop) taken.damaged = index;
  if (checked != Refusal::none && !stop) {
    taken.answer = acknowledge(asked, checked);
  } else if (m.opcode == Opcode::claim) {
    taken.answer = acknowledge(asked, Refusal::none, lease.session);
  } else if (m.opcode == Opcode::release) {
    lease.session = 0;
    taken.answer = acknowledge(asked, Refusal::none);
  } else if (m.opcode >= opcodes) {
    taken.answer = acknowledge(asked, Refusal::out_of_range);
  } else if (waiting_.size() == most_waiting) {
    taken.answer = acknowledge(asked, Refusal::too_many);
  } else {
    waiting_.push_back(asked);
    taken.command = Command{index, static_cast<Verb>(m.opcode), m.value, Source::can};
  }
  return taken;
}

/// A claim whose answer was lost is repeated, and granted again while nothing has come since.
Refusal Commands::claim_lease(Lease& lease, const Asked& asked, hal::Time now) {
  const bool again = lease.session != 0 && !lease.used && lease.claimed_as == asked.session;
  if (lease.session != 0 && !again) return Refusal::not_yours;
  if (!again) lease.session = lease.last_session = new_session(lease);
  lease.claimed_as = asked.session;
  lease.used = false;
  lease.counter = asked.counter;
  lease.last = now;
  return Refusal::none;
}

/// A sequence that was broken goes on from where it is now: the next command is obeyed.
Refusal Commands::check(Lease& lease, const Asked& asked, float value, hal::Time now,
                        bool& damaged) {
  const bool holder = lease.session != 0 && asked.session == lease.session;
  if (asked.opcode == Opcode::claim && value != 0.0F) return Refusal::out_of_range;
  if (asked.opcode == Opcode::claim && !holder) return claim_lease(lease, asked, now);
  if (lease.session == 0) return Refusal::no_lease;
  if (!holder) return Refusal::not_yours;
  damaged = !e2e::follows(asked.counter, lease.counter);
  lease.counter = asked.counter;
  if (damaged) return Refusal::wrong_counter;
  lease.used = true;
  lease.last = now;
  return Refusal::none;
}

std::uint16_t Commands::new_session(const Lease& lease) {
  std::uint16_t session = 0;
  // The engine's own numbers are the same everywhere; a distribution's are not.
  while (session == 0 || session == lease.last_session)
    session = static_cast<std::uint16_t>(random_());
  return session;
}

bool Commands::leased(std::uint8_t channel, hal::Time now) const {
  return live(leases_[channel], now);
}

std::optional<hal::CanFrame> Commands::answered(const Answer& answer) {
  if (waiting_.empty()) return std::nullopt;
  const Asked asked = waiting_.front();
  waiting_.pop_front();
  return acknowledge(asked, answer.refusal);
}

hal::CanFrame Commands::not_taken() {
  const Asked asked = waiting_.back();
  waiting_.pop_back();
  return acknowledge(asked, Refusal::too_many);
}

hal::CanFrame Commands::acknowledge(const Asked& asked, Refusal refusal,
                                    std::uint16_t granted) const {
  supercoil_acknowledge_t m{};
  m.counter = asked.counter;
  m.opcode = asked.opcode;
  m.session = asked.session;
  m.refusal = static_cast<std::uint8_t>(refusal);
  m.granted = granted;
  hal::CanFrame frame =
      packed(SUPERCOIL_ACKNOWLEDGE_FRAME_ID, SUPERCOIL_ACKNOWLEDGE_LENGTH,
             static_cast<Node>(first_node_ + asked.channel), m, supercoil_acknowledge_pack);
  e2e::protect(frame);
  return frame;
}

}  // namespace supercoil::telemetry
