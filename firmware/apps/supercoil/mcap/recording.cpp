#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "apps/supercoil/mcap/export.hpp"
#include "can/codec.hpp"
#include "recorder/quantities.hpp"

namespace supercoil::operating::mcap {

namespace {

using nlohmann::ordered_json;

/// With enough digits to read back the same value.
template <class Number>
void add_number(std::string& json, Number value) {
  if (!std::isfinite(value)) {
    json += "null";
    return;
  }
  std::array<char, 40> text{};
  json.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

ordered_json properties() {
  ordered_json all;
  all["time_s"] = {{"type", "number"}, {"description", "in s, relative to the fault"}};
  for (const recorder::Quantity& quantity : recorder::quantities) {
    ordered_json& property = all[std::string(quantity.name)];
    property["type"] =
        quantity.word != nullptr ? ordered_json("string") : ordered_json({"number", "null"});
    describe_unit(property, can::unit_of(quantity.name));
  }
  // On the bus there are two signals for it, one per unit.
  all["reference"]["description"] = "in m; in mode power in W";
  return all;
}

/// No escaping: names of states and the like do not need it.
std::string row_json(const Row& row, double time_s) {
  std::string json = "{\"time_s\":";
  add_number(json, time_s);
  for (const recorder::Quantity& quantity : recorder::quantities) {
    json.append(",\"").append(quantity.name).append("\":");
    const double value = quantity.of(row);
    if (quantity.word != nullptr) {
      json.append("\"").append(quantity.word(static_cast<std::uint8_t>(value))).append("\"");
    } else {
      add_number(json, static_cast<float>(value));
    }
  }
  return json + "}";
}

Entries header_entries(const recorder::Header& header) {
  return {{"program", header.program},
          {"channels", std::to_string(header.channels)},
          {"rate_Hz", ordered_json(header.rate_Hz).dump()},
          {"fault", header.fault_name},
          {"fault_number", std::to_string(header.fault)},
          {"fault_channel", std::to_string(header.fault_channel + 1)},
          {"fault_time_ns", std::to_string(header.fault_time_ns)}};
}

}  // namespace

Written from_recording(const recorder::Recording& recording, const recorder::Sink& write) {
  Writer writer(write);
  writer.add_metadata("recording", header_entries(recording.header));
  const auto faults =
      writer.add_channel("/faults", "supercoil.Fault",
                         {{"channel", {{"type", "integer"}}},
                          {"fault", {{"type", "string"}, {"description", "none: it was reset"}}}});
  std::map<int, std::uint16_t> channels;
  std::array<std::uint8_t, 256> fault_of{};
  for (const Row& row : recording.rows) {
    const auto time_ns = static_cast<std::uint64_t>(row.time_ns);
    const int number = row.channel + 1;
    if (!channels.contains(number)) {
      channels[number] =
          writer.add_channel("/channel_" + std::to_string(number), "supercoil.Row", properties());
      // When a fault of the first row latched is not known.
      fault_of.at(row.channel) = row.fault;
    }
    if (row.fault != fault_of.at(row.channel)) {
      fault_of.at(row.channel) = row.fault;
      const ordered_json fault{{"channel", number}, {"fault", recorder::fault_name(row.fault)}};
      if (auto done = writer.add_message(faults, time_ns, fault.dump()); !done) return done;
    }
    auto done = writer.add_message(channels[number], time_ns, row_json(row, recording.time_s(row)));
    if (!done) return done;
  }
  return writer.finish();
}

}  // namespace supercoil::operating::mcap
