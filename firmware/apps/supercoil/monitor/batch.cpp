#include "apps/supercoil/monitor/batch.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"

namespace supercoil::operating {

namespace {

/// Columns of one message of one node, as text: an hour has millions of numbers, too many for a
/// tree of JSON values.
struct Columns {
  std::string time_s;
  std::array<std::string, can::max_signals> values;
};

using Key = std::pair<std::uint8_t, const can::MessageInfo*>;

void add_number(std::string& text, double value, int precision) {
  if (!std::isfinite(value)) {
    text += "null,";
    return;
  }
  std::array<char, 40> digits{};
  const auto end =
      std::to_chars(digits.begin(), digits.end(), value, std::chars_format::general, precision);
  text.append(digits.begin(), end.ptr);
  text += ',';
}

/// With microseconds: nine digits would not suffice for a time since 1970.
void add_time(std::string& text, hal::Time time) {
  std::array<char, 40> digits{};
  const auto end =
      std::to_chars(digits.begin(), digits.end(), hal::seconds(time), std::chars_format::fixed, 6);
  text.append(digits.begin(), end.ptr);
  text += ',';
}

void add_column(std::string& text, std::string_view name, std::string& numbers) {
  if (!numbers.empty()) numbers.pop_back();
  text.append("\"").append(name).append("\":[").append(numbers).append("],");
}

void close(std::string& text) {
  if (text.back() == ',') text.pop_back();
  text += "},";
}

std::string figures_json(const BusFigures& bus) {
  constexpr int digits = 6;
  std::string text = "{\"load\":";
  add_number(text, bus.load, digits);
  text += "\"frames_per_s\":";
  add_number(text, bus.frames_per_s, digits);
  text += "\"foreign_per_s\":";
  add_number(text, bus.foreign_per_s, digits);
  text.back() = '}';
  return text;
}

/// The page keeps an hour of each signal, in single precision where that is exact enough.
constexpr int single_bits = 24;
constexpr int single_digits = 8;

int digits_on_page(const can::SignalInfo& signal) {
  const bool single = signal.raw == can::Raw::floating || signal.length <= single_bits;
  return single ? single_digits : can::significant_digits(signal);
}

}  // namespace

std::string to_batch(const std::vector<hal::CanFrame>& frames, const FrameHistory& history) {
  std::map<Key, Columns> all;
  const std::vector<std::uint8_t> nodes = history.nodes();
  for (const hal::CanFrame& frame : frames) {
    const auto decoded = can::decode(frame);
    if (!decoded || !std::ranges::binary_search(nodes, decoded->node)) continue;
    Columns& columns = all[{decoded->node, decoded->message}];
    add_time(columns.time_s, frame.received);
    for (std::size_t i = 0; i < decoded->message->signals.size(); ++i) {
      add_number(columns.values.at(i), decoded->values.at(i),
                 can::significant_digits(decoded->message->signals[i]));
    }
  }
  std::string text = "{";
  if (!frames.empty()) {
    text += "\"newest_s\":";
    add_time(text, frames.back().received);
  }
  text += "\"nodes\":{";
  int node = 0;
  for (auto& [key, columns] : all) {
    if (key.first != node) {
      if (node != 0) close(text);
      node = key.first;
      text += "\"" + std::to_string(node) + "\":{";
    }
    text.append("\"").append(key.second->name).append("\":{");
    add_column(text, "time_s", columns.time_s);
    for (std::size_t i = 0; i < key.second->signals.size(); ++i)
      add_column(text, key.second->signals[i].name, columns.values.at(i));
    close(text);
  }
  if (node != 0) close(text);
  close(text);
  return text + "\"bus\":" + figures_json(history.figures()) + "}";
}

std::string protocol_json() {
  nlohmann::ordered_json all;
  for (const can::MessageInfo& message : can::all_messages) {
    for (const can::SignalInfo& signal : message.signals) {
      auto& entry = all[std::string(message.name)][std::string(signal.name)];
      entry["unit"] = signal.unit;
      entry["digits"] = digits_on_page(signal);
      for (const can::ValueName& value : signal.names)
        entry["values"][std::to_string(value.raw)] = value.name;
    }
  }
  return all.dump();
}

}  // namespace supercoil::operating
