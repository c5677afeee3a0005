#include "can_client/master.hpp"

#include "can/codec.hpp"
#include "can/generated/messages.hpp"
#include "telemetry/opcodes.hpp"
#include "telemetry/trajectory_frames.hpp"
#include "telemetry/tuning_frames.hpp"

namespace supercoil::can_client {

namespace e2e = can::e2e;
namespace message = can::message;

namespace {

bool ends_lease(Refusal refusal) {
  return refusal == Refusal::no_lease || refusal == Refusal::not_lease_holder;
}

/// Empty: the refusal is from another version of the protocol.
std::optional<Refusal> refusal_in(double number) {
  if (number >= static_cast<double>(refusal_names.size())) return std::nullopt;
  return static_cast<Refusal>(number);
}

/// The signal's value, if the frame is this node's message.
template <const can::MessageInfo& message>
std::optional<double> receive(std::uint8_t node, const hal::CanFrame& frame,
                              can::SignalOf<message> signal) {
  if (frame.id != can::id_of(message, node) || frame.length != message.length) return std::nullopt;
  return can::Reader<message>(frame).get(signal);
}

}  // namespace

std::uint16_t acknowledge_id(std::uint8_t node) {
  return can::id_of(message::acknowledge, node);
}

std::uint16_t setting_id(std::uint8_t node) {
  return can::id_of(message::setting, node);
}

std::uint16_t refused_value_id(std::uint8_t node) {
  return can::id_of(message::refused_value, node);
}

std::optional<double> receive_nearest(std::uint8_t node, const hal::CanFrame& frame) {
  return receive<message::refused_value>(node, frame, "nearest");
}

std::uint16_t status_id(std::uint8_t node) {
  return can::id_of(message::status, node);
}

std::uint16_t estimate_id(std::uint8_t node) {
  return can::id_of(message::estimate, node);
}

hal::CanFrame setting_read(std::uint8_t node, std::uint8_t setting) {
  return can::Encoder<message::setting_read>(node).set("setting", setting).frame();
}

hal::CanFrame muscle_read(std::uint8_t node, std::uint8_t quantity) {
  return can::Encoder<message::muscle_read>(node).set("quantity", quantity).frame();
}

std::uint16_t muscle_id(std::uint8_t node) {
  return can::id_of(message::muscle, node);
}

std::optional<double> receive_muscle(std::uint8_t node, std::uint8_t quantity,
                                     const hal::CanFrame& frame) {
  if (frame.id != muscle_id(node) || frame.length != message::muscle.length) return std::nullopt;
  const can::Reader<message::muscle> m(frame);
  if (m.get<std::uint8_t>("quantity") != quantity) return std::nullopt;
  return m.get("value");
}

std::vector<std::uint16_t> answer_ids(std::uint8_t node) {
  return {acknowledge_id(node), setting_id(node), refused_value_id(node),
          muscle_id(node),      tuning_id(node),  trajectory_id(node)};
}

hal::CanFrame tuning_read(std::uint8_t node, const TunedPlace& place) {
  return can::Encoder<message::tuning_read>(node)
      .set("place", place.place)
      .set("set", static_cast<double>(place.set))
      .set("tunable", place.tunable)
      .frame();
}

std::uint16_t tuning_id(std::uint8_t node) {
  return can::id_of(message::tuning, node);
}

std::optional<TunedValue> receive_tuning(std::uint8_t node, const TunedPlace& place,
                                         const hal::CanFrame& frame) {
  if (frame.id != tuning_id(node) || !e2e::intact(frame, message::tuning.length))
    return std::nullopt;
  const can::Reader<message::tuning> m(frame);
  const bool is_answer = m.get<std::uint8_t>("place") == place.place &&
                         m.get<std::uint8_t>("tunable") == place.tunable &&
                         m.get<std::uint8_t>("set") == static_cast<std::uint8_t>(place.set);
  const auto refusal = refusal_in(m.get("refusal"));
  if (!is_answer || !refusal) return std::nullopt;
  return TunedValue{*refusal, telemetry::shortest_decimal(m.get<float>("value")),
                    m.get<std::uint8_t>("counter")};
}

std::uint16_t trajectory_id(std::uint8_t node) {
  return can::id_of(message::trajectory, node);
}

hal::CanFrame sync(std::uint8_t number, double master_time_s) {
  return can::Encoder<message::sync>(1)
      .set("sync", number)
      .set("master_time_s", master_time_s)
      .protected_frame();
}

std::optional<double> receive_progress(std::uint8_t node, const hal::CanFrame& frame) {
  return receive<message::status>(node, frame, "progress");
}

std::uint16_t measurement_id(std::uint8_t node) {
  return can::id_of(message::measurement, node);
}

std::optional<double> receive_position_m(std::uint8_t node, const hal::CanFrame& frame) {
  return receive<message::measurement>(node, frame, "position_m");
}

std::uint16_t tracking_id(std::uint8_t node) {
  return can::id_of(message::tracking, node);
}

std::optional<double> receive_error_m(std::uint8_t node, const hal::CanFrame& frame) {
  return receive<message::tracking>(node, frame, "error_m");
}

std::uint8_t Master::next_counter() {
  counter_ = static_cast<std::uint8_t>((counter_ + 1) % e2e::counters);
  return counter_;
}

hal::CanFrame Master::frame(std::uint8_t opcode, double value) {
  sent_session_ = opcode == telemetry::lease && session_ == 0 ? name_ : session_;
  releasing_ = opcode == telemetry::lease && value == telemetry::release_value;
  return can::Encoder<message::command>(node_)
      .set("counter", next_counter())
      .set("opcode", opcode)
      .set("session", sent_session_)
      .set("value", value)
      .protected_frame();
}

hal::CanFrame Master::claim() {
  return frame(telemetry::lease,
               session_ == 0 ? static_cast<double>(nonce_) : double{telemetry::claim_value});
}

hal::CanFrame Master::release() {
  return frame(telemetry::lease, telemetry::release_value);
}

hal::CanFrame Master::command(Verb verb, double value) {
  const auto sent = telemetry::encode_command(verb, value);
  return frame(sent.opcode, sent.value);
}

hal::CanFrame Master::setting_write(std::uint8_t setting, double value) {
  sent_session_ = session_;
  return can::Encoder<message::setting_write>(node_)
      .set("counter", next_counter())
      .set("setting", setting)
      .set("session", session_)
      .set("value", value)
      .protected_frame();
}

hal::CanFrame Master::tuning_write(const TunedPlace& place, double value) {
  sent_session_ = session_;
  return can::Encoder<message::tuning_write>(node_)
      .set("counter", next_counter())
      .set("place", place.place)
      .set("tunable", place.tunable)
      .set("session_low", session_ & 0xFFU)
      .set("value", value)
      .protected_frame();
}

std::optional<TunedValue> Master::receive_tuning(const TunedPlace& place,
                                                 const hal::CanFrame& frame) {
  const auto tuned = can_client::receive_tuning(node_, place, frame);
  if (!tuned || tuned->counter != counter_) return std::nullopt;
  if (ends_lease(tuned->refusal)) session_ = 0;
  return tuned;
}

std::optional<Master::Setting> Master::receive_setting(const hal::CanFrame& frame, bool of_write) {
  if (frame.id != setting_id(node_) || !e2e::intact(frame, message::setting.length))
    return std::nullopt;
  const can::Reader<message::setting> m(frame);
  const bool mine = !of_write || (m.get<std::uint8_t>("counter") == counter_ &&
                                  m.get<std::uint16_t>("session_low") == (sent_session_ & 0xFFU));
  const auto refusal = refusal_in(m.get("refusal"));
  if (!mine || !refusal) return std::nullopt;
  if (of_write && ends_lease(*refusal)) session_ = 0;
  return Setting{m.get<std::uint8_t>("setting"), *refusal, m.get<float>("value")};
}

hal::CanFrame Master::knot(double after_s, double position_m, double velocity_m_per_s) {
  sent_session_ = session_;
  return can::Encoder<message::knot>(node_)
      .set("counter", next_counter())
      .set("after_s", after_s)
      .set("position_m", position_m)
      .set("velocity_m_per_s", velocity_m_per_s)
      .protected_frame(session_);
}

hal::CanFrame Master::play(double when, std::uint8_t sync, double after_s) {
  sent_session_ = session_;
  return can::Encoder<message::play>(node_)
      .set("counter", next_counter())
      .set("when", when)
      .set("session", session_)
      .set("sync", sync)
      .set("after_s", after_s)
      .protected_frame();
}

hal::CanFrame Master::play_at_once(double after_s) {
  return play(telemetry::at_once, 0, after_s);
}

hal::CanFrame Master::play_at_sync(std::uint8_t sync, double after_s) {
  return play(telemetry::at_sync, sync, after_s);
}

hal::CanFrame Master::play_never() {
  return play(telemetry::never, 0, 0.0);
}

std::optional<Played> Master::receive_played(const hal::CanFrame& frame) {
  if (frame.id != trajectory_id(node_) || !e2e::intact(frame, message::trajectory.length))
    return std::nullopt;
  const can::Reader<message::trajectory> m(frame);
  const bool mine = m.get<std::uint8_t>("answers") != telemetry::nothing &&
                    m.get<std::uint8_t>("counter") == counter_ &&
                    m.get<std::uint16_t>("session_low") == (sent_session_ & 0xFFU);
  const auto refusal = refusal_in(m.get("refusal"));
  const auto state = m.get<std::uint8_t>("playback");
  if (!mine || !refusal || state >= playback_state_names.size()) return std::nullopt;
  if (ends_lease(*refusal)) session_ = 0;
  return Played{*refusal, static_cast<PlaybackState>(state), m.get<std::uint8_t>("room"),
                m.get("buffered_s")};
}

void Master::receive_lease(Refusal refusal, std::uint16_t granted) {
  nonce_ = refusal == Refusal::claim_again ? granted : 0;
  if (refusal == Refusal::claim_again) session_ = 0;
  if (refusal == Refusal::none) session_ = releasing_ ? 0 : granted;
}

std::optional<Master::Acknowledged> Master::receive_acknowledge(const hal::CanFrame& frame) {
  if (frame.id != acknowledge_id(node_) || !e2e::intact(frame, message::acknowledge.length))
    return std::nullopt;
  const can::Reader<message::acknowledge> m(frame);
  const bool mine = m.get<std::uint8_t>("counter") == counter_ &&
                    m.get<std::uint16_t>("session") == sent_session_;
  const auto refusal = refusal_in(m.get("refusal"));
  if (!mine || !refusal) return std::nullopt;
  const auto opcode = m.get<std::uint8_t>("opcode");
  if (opcode == telemetry::lease) receive_lease(*refusal, m.get<std::uint16_t>("granted"));
  if (ends_lease(*refusal)) session_ = 0;
  return Acknowledged{opcode, *refusal};
}

}  // namespace supercoil::can_client
