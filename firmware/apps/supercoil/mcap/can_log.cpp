#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "apps/supercoil/mcap/export.hpp"
#include "can/codec.hpp"

namespace supercoil::operating::mcap {

namespace {

using can::SignalInfo;
using nlohmann::ordered_json;

ordered_json properties(const can::MessageInfo& message) {
  ordered_json all;
  for (const SignalInfo& signal : message.signals) {
    ordered_json& property = all[std::string(signal.name)];
    property["type"] = {"number", "string", "null"};
    describe_unit(property, signal.unit);
  }
  return all;
}

/// The value's name if it has one.
ordered_json value_json(const SignalInfo& signal, double value) {
  if (const auto name = can::value_name(signal, value); !name.empty()) return std::string(name);
  return std::isfinite(value) ? ordered_json(value) : nullptr;
}

}  // namespace

Result<std::size_t> from_can_log(const std::vector<hal::CanFrame>& frames,
                                 const CanSelection& selection, const recorder::Sink& write) {
  Writer writer(write);
  std::map<std::string, std::uint16_t> channels;
  std::size_t messages = 0;
  for (const hal::CanFrame& frame : frames) {
    const auto decoded = can::decode(frame);
    if (!decoded || !is_wanted(selection, *decoded, hal::seconds(frame.received))) continue;
    const std::string name(decoded->message->name);
    const std::string topic = "/node_" + std::to_string(int{decoded->node}) + "/" + name;
    if (!channels.contains(topic)) {
      channels[topic] =
          writer.add_channel(topic, "supercoil." + name, properties(*decoded->message));
    }
    ordered_json json = ordered_json::object();
    for (std::size_t i = 0; i < decoded->message->signals.size(); ++i) {
      const SignalInfo& signal = decoded->message->signals[i];
      json[std::string(signal.name)] = value_json(signal, decoded->values.at(i));
    }
    const auto time_ns = static_cast<std::uint64_t>(frame.received.count());
    if (auto done = writer.add_message(channels[topic], time_ns, json.dump()); !done)
      return tl::unexpected(done.error());
    ++messages;
  }
  if (messages == 0) return messages;
  if (auto done = writer.finish(); !done) return tl::unexpected(done.error());
  return messages;
}

}  // namespace supercoil::operating::mcap
