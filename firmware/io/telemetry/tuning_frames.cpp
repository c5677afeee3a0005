#include "telemetry/tuning_frames.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"
#include "telemetry/frames.hpp"

namespace supercoil::telemetry {

namespace {

namespace message = can::message;

}  // namespace

double shortest_decimal(float value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double number = NAN;
  std::from_chars(text.data(), end, number);
  return number;
}

TakenWrite TuningFrames::take(const hal::CanFrame& frame, hal::Time now) {
  const auto to = [&](const can::MessageInfo& message) {
    return can::channel_of(frame, message, first_node_, leases_->channels());
  };
  if (const auto channel = to(message::tuning_write)) return take_write(*channel, frame, now);
  const auto channel = to(message::tuning_read);
  if (!channel || frame.length != message::tuning_read.length) return {};
  const can::Reader<message::tuning_read> m(frame);
  const auto place = m.get<std::uint8_t>("place");
  const auto tunable = m.get<std::uint8_t>("tunable");
  const auto set = static_cast<TuningSet>(m.get<std::uint8_t>("set"));
  const bool known = !std::isnan(loop_->channel(*channel).tuner().value(set, place, tunable));
  const Refusal refusal = known ? Refusal::none : Refusal::out_of_range;
  return {{}, tuning_frame(*channel, set, place, tunable, refusal, 0), {}};
}

TakenWrite TuningFrames::take_write(std::uint8_t channel, const hal::CanFrame& frame,
                                    hal::Time now) {
  if (!can::e2e::intact(frame, message::tuning_write.length)) return {channel, {}, {}};
  const can::Reader<message::tuning_write> m(frame);
  const auto counter = m.get<std::uint8_t>("counter");
  const auto place = m.get<std::uint8_t>("place");
  const auto tunable = m.get<std::uint8_t>("tunable");
  const auto value = m.get<float>("value");
  const std::uint16_t session = leases_->session(channel);
  const bool holder = (session & 0xFFU) == m.get<std::uint8_t>("session_low");
  TakenWrite taken;
  Reply reply = leases_->check(channel, holder ? session : 0, counter, now);
  if (reply.refusal == Refusal::wrong_counter) taken.damaged = channel;
  if (reply.refusal == Refusal::none) reply = prepare(channel, place, tunable, value);
  taken.answer = tuning_frame(channel, TuningSet::prepared, place, tunable, reply.refusal, counter);
  if (reply.refusal == Refusal::out_of_range) {
    taken.refused_value =
        refused_value(static_cast<can::Node>(first_node_ + channel), value, reply.nearest);
  }
  return taken;
}

Reply TuningFrames::prepare(std::uint8_t channel, std::uint8_t place, std::uint8_t tunable,
                            float value) {
  Tuner& tuner = loop_->channel(channel).tuner();
  if (tunable != all_tunables) return tuner.prepare(place, tunable, shortest_decimal(value));
  const bool is_set = value >= 0.0F && value < static_cast<float>(tuning_set_names.size());
  const bool done =
      is_set && tuner.prepare_from(static_cast<TuningSet>(static_cast<std::uint8_t>(value)), place);
  return done ? Refusal::none : Refusal::out_of_range;
}

hal::CanFrame TuningFrames::tuning_frame(std::uint8_t channel, TuningSet set, std::uint8_t place,
                                         std::uint8_t tunable, Refusal refusal,
                                         std::uint8_t counter) const {
  const Tuner& tuner = static_cast<const Loop*>(loop_)->channel(channel).tuner();
  return can::Encoder<message::tuning>(static_cast<can::Node>(first_node_ + channel))
      .set("counter", counter)
      .set("place", place)
      .set("tunable", tunable)
      .set("refusal", static_cast<double>(refusal))
      .set("set", static_cast<double>(set))
      .set("value", tuner.value(set, place, tunable))
      .protected_frame();
}

}  // namespace supercoil::telemetry
