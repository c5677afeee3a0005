#include "can_client/master.hpp"

#include <supercoil.h>

#include "telemetry/e2e.hpp"
#include "telemetry/opcodes.hpp"
#include "telemetry/pack.hpp"

namespace supercoil::can_client {

namespace e2e = telemetry::e2e;

namespace {

bool ends_lease(Refusal refusal) {
  return refusal == Refusal::no_lease || refusal == Refusal::not_yours;
}

}  // namespace

std::uint16_t acknowledge_id(std::uint8_t node) {
  return telemetry::id_of(SUPERCOIL_ACKNOWLEDGE_FRAME_ID, node);
}

std::uint16_t setting_id(std::uint8_t node) {
  return telemetry::id_of(SUPERCOIL_SETTING_FRAME_ID, node);
}

std::uint16_t refused_value_id(std::uint8_t node) {
  return telemetry::id_of(SUPERCOIL_REFUSED_VALUE_FRAME_ID, node);
}

std::optional<double> hear_nearest(std::uint8_t node, const hal::CanFrame& frame) {
  if (frame.id != refused_value_id(node) || frame.length != SUPERCOIL_REFUSED_VALUE_LENGTH)
    return std::nullopt;
  supercoil_refused_value_t m{};
  supercoil_refused_value_unpack(&m, frame.data.data(), frame.length);
  return m.nearest;
}

std::uint16_t status_id(std::uint8_t node) {
  return telemetry::id_of(SUPERCOIL_STATUS_FRAME_ID, node);
}

std::uint16_t estimate_id(std::uint8_t node) {
  return telemetry::id_of(SUPERCOIL_ESTIMATE_FRAME_ID, node);
}

hal::CanFrame setting_read(std::uint8_t node, std::uint8_t setting) {
  const supercoil_setting_read_t m{setting};
  return telemetry::packed(SUPERCOIL_SETTING_READ_FRAME_ID, SUPERCOIL_SETTING_READ_LENGTH, node, m,
                           supercoil_setting_read_pack);
}

std::uint8_t Master::next_counter() {
  counter_ = static_cast<std::uint8_t>((counter_ + 1) % e2e::counters);
  return counter_;
}

hal::CanFrame Master::frame(std::uint8_t opcode, double value) {
  asked_as_ = opcode == telemetry::lease && session_ == 0 ? name_ : session_;
  releasing_ = opcode == telemetry::lease && value == telemetry::releases;
  supercoil_command_t m{};
  m.counter = next_counter();
  m.opcode = opcode;
  m.session = asked_as_;
  m.value = static_cast<float>(value);
  return telemetry::sealed(SUPERCOIL_COMMAND_FRAME_ID, SUPERCOIL_COMMAND_LENGTH, node_, m,
                           supercoil_command_pack);
}

hal::CanFrame Master::claim() {
  return frame(telemetry::lease,
               session_ == 0 ? static_cast<double>(nonce_) : double{telemetry::claims});
}

hal::CanFrame Master::release() {
  return frame(telemetry::lease, telemetry::releases);
}

hal::CanFrame Master::command(Verb verb, double value) {
  const auto sent = telemetry::sent(verb, value);
  return frame(sent.opcode, sent.value);
}

hal::CanFrame Master::setting_write(std::uint8_t setting, double value) {
  asked_as_ = session_;
  supercoil_setting_write_t m{};
  m.counter = next_counter();
  m.setting = setting;
  m.session = session_;
  m.value = static_cast<float>(value);
  return telemetry::sealed(SUPERCOIL_SETTING_WRITE_FRAME_ID, SUPERCOIL_SETTING_WRITE_LENGTH, node_,
                           m, supercoil_setting_write_pack);
}

std::optional<Master::Setting> Master::hear_setting(const hal::CanFrame& frame, bool of_write) {
  if (frame.id != setting_id(node_) || !e2e::intact(frame, SUPERCOIL_SETTING_LENGTH))
    return std::nullopt;
  supercoil_setting_t m{};
  supercoil_setting_unpack(&m, frame.data.data(), frame.length);
  const bool mine = !of_write || (m.counter == counter_ && m.session_low == (asked_as_ & 0xFFU));
  if (!mine || m.refusal >= refusal_names.size()) return std::nullopt;
  const auto refusal = static_cast<Refusal>(m.refusal);
  if (of_write && ends_lease(refusal)) session_ = 0;
  return Setting{m.setting, refusal, m.value};
}

void Master::hear_of_lease(Refusal refusal, std::uint16_t granted) {
  nonce_ = refusal == Refusal::claim_again ? granted : 0;
  if (refusal == Refusal::claim_again) session_ = 0;
  if (refusal == Refusal::none) session_ = releasing_ ? 0 : granted;
}

std::optional<Master::Heard> Master::hear(const hal::CanFrame& frame) {
  if (frame.id != acknowledge_id(node_) || !e2e::intact(frame, SUPERCOIL_ACKNOWLEDGE_LENGTH))
    return std::nullopt;
  supercoil_acknowledge_t m{};
  supercoil_acknowledge_unpack(&m, frame.data.data(), frame.length);
  if (m.counter != counter_ || m.session != asked_as_ || m.refusal >= refusal_names.size())
    return std::nullopt;
  const auto refusal = static_cast<Refusal>(m.refusal);
  if (m.opcode == telemetry::lease) hear_of_lease(refusal, m.granted);
  if (ends_lease(refusal)) session_ = 0;
  return Heard{m.opcode, refusal};
}

}  // namespace supercoil::can_client
