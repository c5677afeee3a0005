#include "telemetry/schedule.hpp"

#include <cmath>

namespace supercoil::telemetry {

namespace {

/// Multiples of it modulo 1 lie as far from each other as can be, however many there are.
constexpr double golden = 0.6180339887498949;

bool is_sent(const Rates& rates_Hz, std::size_t message, std::size_t channel) {
  return rates_Hz[message] > 0.0 && (channel == 0 || !all_messages()[message].of_board);
}

}  // namespace

Rates usual_rates() {
  Rates rates{};
  for (std::size_t i = 0; i < messages; ++i)
    rates[i] = all_messages()[i].usual_Hz;
  return rates;
}

double bus_load(const Rates& rates_Hz, std::size_t channels, double bit_rate) {
  double bits_per_s = 0.0;
  for (std::size_t channel = 0; channel < channels; ++channel) {
    for (std::size_t i = 0; i < messages; ++i) {
      if (is_sent(rates_Hz, i, channel))
        bits_per_s += rates_Hz[i] * most_bits(all_messages()[i].length);
    }
  }
  return bits_per_s / bit_rate;
}

Schedule::Schedule(const Rates& rates_Hz, std::size_t channels) {
  for (std::size_t channel = 0; channel < channels; ++channel) {
    for (std::size_t i = 0; i < messages; ++i) {
      if (!is_sent(rates_Hz, i, channel)) continue;
      const hal::Duration period = hal::duration_from(1.0 / rates_Hz[i]);
      slots_.push_back(
          {static_cast<std::uint8_t>(channel), static_cast<Message>(i), period, hal::Time{}});
    }
  }
  // Those of one period share it evenly; the groups are set off against each other.
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
