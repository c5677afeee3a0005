#include "telemetry/commands.hpp"

#include <algorithm>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"
#include "telemetry/opcodes.hpp"

namespace supercoil::telemetry {

Commands::Commands(const CanSettings& settings, Leases& leases)
    : first_node_(settings.first_node), leases_(&leases) {}

Commands::Taken Commands::take(const hal::CanFrame& frame, hal::Time now) {
  const auto channel =
      can::channel_of(frame, can::message::command, first_node_, leases_->channels());
  if (!channel) return {};
  Taken taken;
  if (!can::e2e::intact(frame, can::message::command.length)) {
    taken.damaged = *channel;
    return taken;
  }
  const can::Reader<can::message::command> m(frame);
  const CommandHeader header{*channel, m.get<std::uint8_t>("opcode"),
                             m.get<std::uint8_t>("counter"), m.get<std::uint16_t>("session")};
  const auto value = m.get<float>("value");

  // Obeyed from every master, whatever is wrong with lease and counter.
  const bool stop = header.opcode == static_cast<std::uint8_t>(Verb::disarm) && value == 0.0F;
  const Refusal checked = check(header, value, now);
  if (checked == Refusal::wrong_counter && !stop) taken.damaged = *channel;
  if (checked == Refusal::claim_again) {
    taken.answer = acknowledge(header, checked, leases_->nonce(*channel));
  } else if (checked != Refusal::none && !stop) {
    taken.answer = acknowledge(header, checked);
  } else if (header.opcode == Opcode::lease && value == release_value) {
    leases_->release(*channel);
    taken.answer = acknowledge(header, Refusal::none);
  } else if (header.opcode == Opcode::lease) {
    taken.answer = acknowledge(header, Refusal::none, leases_->session(*channel));
  } else if (waiting_.full()) {
    taken.answer = acknowledge(header, Refusal::queue_full);
  } else {
    taken.command = decode_command(header.opcode, static_cast<double>(value));
    taken.command->channel = *channel;
    taken.command->source = Source::can;
    taken.command->id = waiting_.add(header);
  }
  return taken;
}

Refusal Commands::check(const CommandHeader& header, float value, hal::Time now) {
  const bool known = header.opcode != Opcode::claim_of_version_3;
  const bool holder =
      leases_->held(header.channel, now) && header.session == leases_->session(header.channel);
  if (known && header.opcode == Opcode::lease && value != release_value && !holder)
    return leases_->claim(header.channel, header.session, value, header.counter, now);
  const Refusal checked = leases_->check(header.channel, header.session, header.counter, now);
  // The holder's counter advances even with a frame that means nothing: otherwise a frame that was
  // heard before it would be obeyed again.
  if (!known && checked != Refusal::wrong_counter) return Refusal::protocol_mismatch;
  const bool is_valid =
      header.opcode != Opcode::lease || value == claim_value || value == release_value;
  return is_valid || checked != Refusal::none ? checked : Refusal::out_of_range;
}

std::optional<hal::CanFrame> Commands::answered(const Answer& answer) {
  const auto header = waiting_.answered(answer.command.id);
  if (!header) return std::nullopt;
  return acknowledge(*header, answer.refusal);
}

hal::CanFrame Commands::not_taken() {
  return acknowledge(waiting_.take_back(), Refusal::queue_full);
}

hal::CanFrame Commands::acknowledge(const CommandHeader& header, Refusal refusal,
                                    std::uint16_t granted) const {
  return can::Encoder<can::message::acknowledge>(
             static_cast<can::Node>(first_node_ + header.channel))
      .set("counter", header.counter)
      .set("opcode", header.opcode)
      .set("session", header.session)
      .set("refusal", static_cast<double>(refusal))
      .set("granted", granted)
      .protected_frame();
}

}  // namespace supercoil::telemetry
