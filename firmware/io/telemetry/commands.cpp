#include "telemetry/commands.hpp"

#include <supercoil.h>

#include "telemetry/e2e.hpp"
#include "telemetry/opcodes.hpp"
#include "telemetry/pack.hpp"

namespace supercoil::telemetry {

Commands::Commands(const CanSettings& settings, Leases& leases)
    : first_node_(settings.first_node), leases_(&leases) {}

Commands::Taken Commands::take(const hal::CanFrame& frame, hal::Time now) {
  const auto channel =
      channel_of(frame, SUPERCOIL_COMMAND_FRAME_ID, first_node_, leases_->channels());
  if (!channel) return {};
  Taken taken;
  if (!e2e::intact(frame, SUPERCOIL_COMMAND_LENGTH)) {
    taken.damaged = *channel;
    return taken;
  }
  supercoil_command_t m{};
  supercoil_command_unpack(&m, frame.data.data(), frame.length);
  const Asked asked{*channel, m.opcode, m.counter, m.session};

  // From everybody, whatever is wrong with lease and counter.
  const bool stop = m.opcode == static_cast<std::uint8_t>(Verb::disarm) && m.value == 0.0F;
  const Refusal checked = check(asked, m.value, now);
  if (checked == Refusal::wrong_counter && !stop) taken.damaged = *channel;
  if (checked == Refusal::claim_again) {
    taken.answer = acknowledge(asked, checked, leases_->nonce(*channel));
  } else if (checked != Refusal::none && !stop) {
    taken.answer = acknowledge(asked, checked);
  } else if (m.opcode == Opcode::lease && m.value == releases) {
    leases_->release(*channel);
    taken.answer = acknowledge(asked, Refusal::none);
  } else if (m.opcode == Opcode::lease) {
    taken.answer = acknowledge(asked, Refusal::none, leases_->session(*channel));
  } else if (waiting_.size() == most_waiting) {
    taken.answer = acknowledge(asked, Refusal::too_many);
  } else {
    waiting_.push_back(asked);
    taken.command = meant(m.opcode, static_cast<double>(m.value));
    taken.command->channel = *channel;
    taken.command->source = Source::can;
  }
  return taken;
}

Refusal Commands::check(const Asked& asked, float value, hal::Time now) {
  const bool known = asked.opcode != Opcode::claim_of_version_3;
  const bool holder =
      leases_->held(asked.channel, now) && asked.session == leases_->session(asked.channel);
  if (known && asked.opcode == Opcode::lease && value != releases && !holder)
    return leases_->claim(asked.channel, asked.session, value, asked.counter, now);
  const Refusal checked = leases_->check(asked.channel, asked.session, asked.counter, now);
  // Also of a frame that means nothing, the holder's counter goes on: else a frame that was heard
  // before it would be obeyed once more.
  if (!known && checked != Refusal::wrong_counter) return Refusal::other_version;
  const bool meant = asked.opcode != Opcode::lease || value == claims || value == releases;
  return meant || checked != Refusal::none ? checked : Refusal::out_of_range;
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
  return sealed(SUPERCOIL_ACKNOWLEDGE_FRAME_ID, SUPERCOIL_ACKNOWLEDGE_LENGTH,
                static_cast<Node>(first_node_ + asked.channel), m, supercoil_acknowledge_pack);
}

}  // namespace supercoil::telemetry
