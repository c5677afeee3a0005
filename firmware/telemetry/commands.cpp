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
  ids.reserve(channels);
  const int first = command_base + settings.first_node;
  for (int i = 0; i < static_cast<int>(channels); ++i)
    ids.push_back(static_cast<std::uint16_t>(first + i));
  return ids;
}

Commands::Commands(const CanSettings& settings, Leases& leases)
    : first_node_(settings.first_node), leases_(&leases) {}

Commands::Taken Commands::take(const hal::CanFrame& frame, hal::Time now) {
  const int channel = frame.id - command_base - first_node_;
  if (channel < 0 || channel >= static_cast<int>(leases_->channels())) return {};
  Taken taken;
  const auto index = static_cast<std::uint8_t>(channel);
  if (!e2e::intact(frame, SUPERCOIL_COMMAND_LENGTH)) {
    taken.damaged = index;
    return taken;
  }
  supercoil_command_t m{};
  supercoil_command_unpack(&m, frame.data.data(), frame.length);
  const Asked asked{index, m.opcode, m.counter, m.session};

  // From everybody, whatever is wrong with lease and counter.
  const bool stop = m.opcode == static_cast<std::uint8_t>(Verb::disarm) && m.value == 0.0F;
  const Refusal checked = check(asked, m.value, now);
  if (checked == Refusal::wrong_counter && !stop) taken.damaged = index;
  if (checked != Refusal::none && !stop) {
    taken.answer = acknowledge(asked, checked);
  } else if (m.opcode == Opcode::claim) {
    taken.answer = acknowledge(asked, Refusal::none, leases_->session(index));
  } else if (m.opcode == Opcode::release) {
    leases_->release(index);
    taken.answer = acknowledge(asked, Refusal::none);
  } else if (waiting_.size() == most_waiting) {
    taken.answer = acknowledge(asked, Refusal::too_many);
  } else {
    waiting_.push_back(asked);
    taken.command = Command{index, static_cast<Verb>(m.opcode), m.value, Source::can};
  }
  return taken;
}

Refusal Commands::check(const Asked& asked, float value, hal::Time now) {
  if (asked.opcode != Opcode::claim)
    return leases_->check(asked.channel, asked.session, asked.counter, now);
  if (value != 0.0F) return Refusal::out_of_range;
  return leases_->claim(asked.channel, asked.session, asked.counter, now);
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
