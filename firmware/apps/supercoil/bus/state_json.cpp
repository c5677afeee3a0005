#include "apps/supercoil/bus/state_json.hpp"

#include <cmath>
#include <map>
#include <string>

#include "can/codec.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

Json value_json(const can::SignalInfo& signal, double value) {
  if (std::isnan(value)) return nullptr;
  const std::string_view name = can::value_name(signal, value);
  return name.empty() ? Json(value) : Json(name);
}

}  // namespace

Json state_json(const FrameHistory& frame_history) {
  std::map<int, Json> nodes;
  // At its default rate every message is sent within this time; at a lower one it may be missing.
  for (const hal::CanFrame& frame :
       frame_history.between(-std::chrono::seconds(3), hal::Time::max())) {
    const auto decoded = can::decode(frame);
    if (!decoded || decoded->message->to_node) continue;
    Json& message = nodes[decoded->node][std::string(decoded->message->name)];
    for (std::size_t i = 0; i < decoded->message->signals.size(); ++i) {
      const can::SignalInfo& signal = decoded->message->signals[i];
      const std::string name(signal.name);
      // A multiplexed signal keeps the value from the last frame that carried it.
      const bool elsewhere =
          signal.selected_by != can::always && decoded->values[0] != signal.selected_by;
      if (elsewhere && message.contains(name)) continue;
      message[name] = value_json(signal, decoded->values.at(i));
    }
  }
  Json result{{"nodes", Json::array()}};
  for (auto& [number, messages] : nodes) {
    Json node{{"node", number}};
    node.update(messages);
    result["nodes"].push_back(node);
  }
  return result;
}

}  // namespace supercoil::operating
