#include "telemetry/run_settings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"

namespace supercoil::telemetry {

namespace {

namespace message = can::message;

constexpr std::uint8_t max_power = 0;

Message message_of(std::uint8_t setting) {
  return static_cast<Message>(setting - 1);
}

}  // namespace

std::string run_setting_name(std::uint8_t setting) {
  if (setting == max_power) return "max_power_W";
  if (setting >= supply_gain) {
    constexpr std::array names{"supply_gain", "current_gain", "sense_error_ratio"};
    return names.at(static_cast<std::size_t>(setting - supply_gain));
  }
  return std::string(periodic_messages()[setting - 1U].name) + "_Hz";
}

RunSettings::RunSettings(CanSettings can, const BoardSettings& board, Leases& leases,
                         Publisher& publisher, Loop& loop)
    : can_(std::move(can)),
      tick_Hz_(board.rate_Hz),
      leases_(&leases),
      publisher_(&publisher),
      loop_(&loop) {
  for (const ChannelSettings& channel : board.channels)
    max_W_.push_back(channel.limiter.max_W);
}

TakenWrite RunSettings::take(const hal::CanFrame& frame, hal::Time now) {
  const auto meant = [&](const can::MessageInfo& message) {
    return can::channel_of(frame, message, can_.first_node, max_W_.size());
  };
  if (const auto channel = meant(message::setting_write)) return take_write(*channel, frame, now);
  const auto channel = meant(message::setting_read);
  if (!channel || frame.length != message::setting_read.length) return {};
  const auto setting = can::Reader<message::setting_read>(frame).get<std::uint8_t>("setting");
  const bool known = !std::isnan(value_of(*channel, setting));
  return {{},
          setting_frame(*channel, setting, known ? Refusal::none : Refusal::out_of_range, 0, 0),
          {}};
}

TakenWrite RunSettings::take_write(std::uint8_t channel, const hal::CanFrame& frame,
                                   hal::Time now) {
  if (!can::e2e::intact(frame, message::setting_write.length)) return {channel, {}, {}};
  const can::Reader<message::setting_write> m(frame);
  const auto counter = m.get<std::uint8_t>("counter");
  const auto session = m.get<std::uint16_t>("session");
  const auto setting = m.get<std::uint8_t>("setting");
  const auto value = m.get("value");
  TakenWrite taken;
  Refusal refusal = leases_->check(channel, session, counter, now);
  if (refusal == Refusal::wrong_counter) taken.damaged = channel;
  if (refusal == Refusal::none) refusal = set(channel, setting, value);
  taken.answer = setting_frame(channel, setting, refusal, counter, session);
  if (refusal == Refusal::out_of_range) {
    const auto node = static_cast<can::Node>(can_.first_node + channel);
    taken.refused_value = refused_value(node, value, nearest(channel, setting, value));
  }
  return taken;
}

Refusal RunSettings::set(std::uint8_t channel, std::uint8_t setting, double value) {
  const bool only_read = setting >= supply_gain;
  if (only_read || std::isnan(value_of(channel, setting))) return Refusal::out_of_range;
  if (setting != max_power) return set_rate(channel, message_of(setting), value);
  const double max_W = max_W_[channel];
  if (!(value >= 0.0 && value <= float_rounding * max_W)) return Refusal::out_of_range;
  loop_->channel(channel).allow_power(std::fmin(value, max_W));
  return Refusal::none;
}

Refusal RunSettings::set_rate(std::uint8_t channel, Message message, double rate_Hz) {
  if (!is_allowed(message, rate_Hz, tick_Hz_)) return Refusal::out_of_range;
  std::vector<Rates> rates = publisher_->rates_Hz();
  rates[channel][static_cast<std::size_t>(message)] = rate_Hz;
  const double load = bus_load(rates, can_.bit_rate);
  // A lower load is always allowed.
  if (load > can_.max_load && load > bus_load(publisher_->rates_Hz(), can_.bit_rate))
    return Refusal::out_of_range;
  publisher_->set_rates(rates);
  return Refusal::none;
}

double RunSettings::nearest(std::uint8_t channel, std::uint8_t setting, double value) const {
  return setting == max_power ? std::clamp(value, 0.0, max_W_[channel]) : NAN;
}

double RunSettings::value_of(std::uint8_t channel, std::uint8_t setting) const {
  if (setting == max_power) return loop_->channel(channel).max_power_W();
  const board::SenseComparison senses = loop_->channel(channel).senses();
  if (setting == supply_gain) return senses.supply_gain;
  if (setting == current_gain) return senses.current_gain;
  if (setting == sense_error) return senses.error_ratio;
  if (setting >= run_settings || !is_of(channel, message_of(setting))) return NAN;
  return publisher_->rates_Hz()[channel][setting - 1U];
}

hal::CanFrame RunSettings::setting_frame(std::uint8_t channel, std::uint8_t setting,
                                         Refusal refusal, std::uint8_t counter,
                                         std::uint16_t session) const {
  return can::Encoder<message::setting>(static_cast<can::Node>(can_.first_node + channel))
      .set("counter", counter)
      .set("setting", setting)
      .set("refusal", static_cast<double>(refusal))
      .set("session_low", session & 0xFFU)
      .set("value", value_of(channel, setting))
      .protected_frame();
}

}  // namespace supercoil::telemetry
