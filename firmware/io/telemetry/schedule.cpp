#include "telemetry/schedule.hpp"

#include <cmath>
#include <utility>

#include "can/generated/messages.hpp"

namespace supercoil::telemetry {

namespace {

/// Its multiples modulo 1 are as far apart as possible, however many there are.
constexpr double golden = 0.6180339887498949;

bool is_sent(const Rates& rates_Hz, std::size_t message, std::size_t channel) {
  return rates_Hz[message] > 0.0 && is_of(channel, static_cast<Message>(message));
}

}  // namespace

Rates default_rates() {
  Rates rates{};
  for (std::size_t i = 0; i < messages; ++i)
    rates[i] = periodic_messages()[i].default_Hz();
  return rates;
}

std::vector<Rates> rates_of(const CanSettings& can, const std::vector<ChannelSettings>& channels) {
  std::vector<Rates> rates_Hz(channels.size(), can.rates_Hz);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].joint.direction <= 0)
      rates_Hz[i][static_cast<std::size_t>(Message::joint)] = 0.0;
  }
  return rates_Hz;
}

bool is_allowed(Message message, double rate_Hz, double tick_Hz) {
  const bool heartbeat = message == Message::status;
  if (rate_Hz == 0.0) return !heartbeat;
  const double min_Hz = heartbeat ? min_status_Hz : min_rate_Hz;
  return rate_Hz >= min_Hz && rate_Hz <= max_rate(tick_Hz);
}

double bus_load(const std::vector<Rates>& of_channels_Hz, double bit_rate) {
  double bits_per_s = 0.0;
  for (std::size_t channel = 0; channel < of_channels_Hz.size(); ++channel) {
    const Rates& rates_Hz = of_channels_Hz[channel];
    for (std::size_t i = 0; i < messages; ++i) {
      if (is_sent(rates_Hz, i, channel))
        bits_per_s += rates_Hz[i] * max_bits(periodic_messages()[i].info->length);
    }
    bits_per_s += max_bits(can::message::boot.length) / hal::seconds(boot_period);
  }
  return bits_per_s / bit_rate;
}

double bus_load(const CanSettings& can, const std::vector<ChannelSettings>& channels) {
  return bus_load(rates_of(can, channels), can.bit_rate);
}

Schedule::Schedule(std::vector<Rates> of_channels_Hz) : rates_Hz_(std::move(of_channels_Hz)) {
  for (std::size_t channel = 0; channel < rates_Hz_.size(); ++channel) {
    const Rates& rates_Hz = rates_Hz_[channel];
    for (std::size_t i = 0; i < messages; ++i) {
      if (!is_sent(rates_Hz, i, channel)) continue;
      const hal::Duration period = hal::duration_from(1.0 / rates_Hz[i]);
      slots_.push_back(
          {static_cast<std::uint8_t>(channel), static_cast<Message>(i), period, hal::Time{}});
    }
  }
  // Messages with the same period share it evenly; such groups are offset against each other.
  int groups = 0;
  for (std::size_t first = 0; first < slots_.size(); ++first) {
    const hal::Duration period = slots_[first].period;
    const auto same = [&](const Slot& slot) { return slot.period == period; };
    const auto before = slots_.begin() + static_cast<std::ptrdiff_t>(first);
    if (std::any_of(slots_.begin(), before, same)) continue;
    const auto count = static_cast<double>(std::count_if(slots_.begin(), slots_.end(), same));
    const double offset = std::fmod(golden * ++groups, 1.0);
    double place = 0.0;
    for (Slot& slot : slots_) {
      if (same(slot))
        slot.next = hal::duration_from((place++ + offset) / count * hal::seconds(period));
    }
  }
}

void Schedule::start(hal::Time now) {
  for (Slot& slot : slots_)
    slot.next += now;
  earliest_ = now;
  started_ = true;
}

}  // namespace supercoil::telemetry
