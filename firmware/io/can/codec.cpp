#include "can/codec.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "can/generated/messages.hpp"

namespace supercoil::can {

namespace {

/// Base identifiers of messages are multiples of this; the rest of an identifier is the node.
constexpr std::uint16_t nodes = 0x40;

std::uint64_t mask_of(const SignalInfo& signal) {
  return (std::uint64_t{1} << signal.length) - 1;
}

std::uint64_t bits(const hal::CanFrame& frame, const SignalInfo& signal) {
  std::uint64_t all = 0;
  for (std::size_t i = frame.data.size(); i-- > 0;)
    all = all << 8U | frame.data[i];
  return all >> signal.start & mask_of(signal);
}

/// The raw bits as a number, before scaling.
std::int64_t integer(std::uint64_t raw, const SignalInfo& signal) {
  const std::uint64_t sign = std::uint64_t{1} << (signal.length - 1U);
  const bool negative = signal.raw == Raw::signed_integer && (raw & sign) != 0;
  return static_cast<std::int64_t>(raw) - (negative ? static_cast<std::int64_t>(sign << 1U) : 0);
}

/// The nearest raw value that the signal can carry.
std::int64_t quantised(double value, const SignalInfo& signal) {
  if (std::isnan(value)) return signal.reserved == no_value ? 0 : signal.reserved;
  const bool is_signed = signal.raw == Raw::signed_integer;
  const std::int64_t half = std::int64_t{1} << (signal.length - 1U);
  std::int64_t min_raw = is_signed ? -half : 0;
  std::int64_t max_raw = is_signed ? half - 1 : 2 * half - 1;
  if (signal.reserved == min_raw) ++min_raw;
  if (signal.reserved == max_raw) --max_raw;
  const double scaled = value / signal.scale;
  if (scaled <= static_cast<double>(min_raw)) return min_raw;
  if (scaled >= static_cast<double>(max_raw)) return max_raw;
  return std::llround(scaled);
}

}  // namespace

void put(hal::CanFrame& frame, const SignalInfo& signal, double value) {
  const std::uint64_t raw = signal.raw == Raw::floating
                                ? std::bit_cast<std::uint32_t>(static_cast<float>(value))
                                : static_cast<std::uint64_t>(quantised(value, signal));
  const std::uint64_t mask = mask_of(signal) << signal.start;
  const std::uint64_t all = raw << signal.start & mask;
  for (std::size_t i = 0; i < frame.data.size(); ++i) {
    const auto kept = static_cast<std::uint8_t>(~(mask >> 8U * i));
    frame.data[i] = static_cast<std::uint8_t>((frame.data[i] & kept) | (all >> 8U * i & 0xFFU));
  }
}

double get(const hal::CanFrame& frame, const SignalInfo& signal) {
  const std::uint64_t raw = bits(frame, signal);
  if (signal.raw == Raw::floating)
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
  const std::int64_t number = integer(raw, signal);
  return number == signal.reserved ? NAN : static_cast<double>(number) * signal.scale;
}

const MessageInfo* find_message(std::string_view name) {
  const auto& all = all_messages;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const MessageInfo& message) { return message.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::size_t signal_index(const MessageInfo& message, std::string_view name) {
  const auto found = std::find_if(message.signals.begin(), message.signals.end(),
                                  [&](const SignalInfo& signal) { return signal.name == name; });
  if (found != message.signals.end())
    return static_cast<std::size_t>(std::distance(message.signals.begin(), found));
  throw std::out_of_range(std::string(message.name) + " has no signal " + std::string(name));
}

std::string_view unit_of(std::string_view signal_name) {
  for (const MessageInfo& message : all_messages) {
    for (const SignalInfo& signal : message.signals) {
      if (signal.name == signal_name && !signal.unit.empty()) return signal.unit;
    }
  }
  return {};
}

std::string_view value_name(const SignalInfo& signal, double value) {
  for (const ValueName& known : signal.names) {
    if (static_cast<double>(known.raw) == value) return known.name;
  }
  return {};
}

std::optional<Decoded> decode(const hal::CanFrame& frame) {
  const auto base = static_cast<std::uint16_t>(frame.id / nodes * nodes);
  const auto& all = all_messages;
  const auto message = std::find_if(all.begin(), all.end(),
                                    [&](const MessageInfo& known) { return known.base == base; });
  const bool is_known = message != all.end() && frame.length == message->length && frame.id != base;
  if (!is_known) return std::nullopt;
  Decoded decoded{&*message, static_cast<std::uint8_t>(frame.id - base), {}};
  decoded.values.fill(NAN);
  for (std::size_t i = 0; i < message->signals.size(); ++i) {
    const SignalInfo& signal = message->signals[i];
    // The first signal of a multiplexed message selects which others are present.
    if (signal.selected_by != always && decoded.values[0] != signal.selected_by) continue;
    decoded.values.at(i) = get(frame, signal);
  }
  return decoded;
}

}  // namespace supercoil::can
