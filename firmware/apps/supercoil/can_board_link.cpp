// Nodes on a CAN bus.
#include <algorithm>
#include <cmath>
#include <optional>
#include <thread>

#include <nlohmann/json.hpp>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/bus/bus_name.hpp"
#include "apps/supercoil/bus/listener.hpp"
#include "apps/supercoil/bus/state_json.hpp"
#include "apps/supercoil/bus/terminal.hpp"
#include "apps/supercoil/tuning_table.hpp"
#include "can/codec.hpp"
#include "modes/result.hpp"
#include "telemetry/run_settings.hpp"
#include "telemetry/tuning_frames.hpp"
#include "text/command_text.hpp"

namespace supercoil::operating {

CanBoardLink::~CanBoardLink() {
  for (const auto& [node, commander] : nodes_)
    commander->release();
}

BoardLink::Answer CanBoardLink::ask(const std::string& line) {
  const auto command = parse_command(line, can::max_nodes, "node");
  if (!command) return command.error().text();
  const auto node = commander(static_cast<std::uint8_t>(command->channel + 1));
  if (!node) return tl::unexpected(node.error());
  const auto answer = (*node)->ask(command->verb, command->value);
  if (!answer) return tl::unexpected(answer.error());
  return answer_text(*answer, *answer == Refusal::out_of_range ? (*node)->nearest() : NAN);
}

Result<Commander*> CanBoardLink::commander(std::uint8_t node) {
  if (!nodes_.contains(node)) {
    auto bus = open_bus(bus_, can_client::answer_ids(node));
    if (!bus) return tl::unexpected(bus.error());
    nodes_.emplace(node, std::make_unique<Commander>(std::move(*bus), node));
  }
  return nodes_.at(node).get();
}

Result<board::SenseComparison> CanBoardLink::senses(const std::string& channel) {
  const auto node = commander(static_cast<std::uint8_t>(std::stoi(channel)));
  if (!node) return tl::unexpected(node.error());
  board::SenseComparison senses;
  using telemetry::SenseSetting;
  for (const auto& [setting, value] : {std::pair{SenseSetting::supply_gain, &senses.supply_gain},
                                       std::pair{SenseSetting::current_gain, &senses.current_gain},
                                       std::pair{SenseSetting::sense_error, &senses.error_ratio}}) {
    const auto reply = (*node)->read(setting);
    if (!reply) return tl::unexpected(reply.error());
    *value = reply->value;
  }
  return senses;
}

Result<KnownMuscle> CanBoardLink::muscle(const std::string& channel) {
  const auto node = commander(static_cast<std::uint8_t>(std::stoi(channel)));
  if (!node) return tl::unexpected(node.error());
  return (*node)->muscle();
}

Result<double> CanBoardLink::tuning(const std::string& channel, int place, std::size_t tunable,
                                    TuningSet set) {
  const auto node = commander(static_cast<std::uint8_t>(std::stoi(channel)));
  if (!node) return tl::unexpected(node.error());
  const auto reply = (*node)->read_tuning(
      {static_cast<std::uint8_t>(place), static_cast<std::uint8_t>(tunable), set});
  if (!reply) return tl::unexpected(reply.error());
  return reply->value;
}

BoardLink::Answer CanBoardLink::prepare(const std::string& channel, int place,
                                        const std::string& name, const std::string& value) {
  const auto node = commander(static_cast<std::uint8_t>(std::stoi(channel)));
  if (!node) return tl::unexpected(node.error());
  const bool all = name == "all";
  const auto tunable =
      all ? telemetry::all_tunables : static_cast<std::uint8_t>(control::tunable_named(name));
  const double number = all ? static_cast<double>(std::ranges::find(tuning_set_names, value) -
                                                  tuning_set_names.begin())
                            : std::stod(value);
  const auto reply =
      (*node)->prepare({static_cast<std::uint8_t>(place), tunable, TuningSet::prepared}, number);
  if (!reply) return tl::unexpected(reply.error());
  const bool out = reply->refusal == Refusal::out_of_range;
  return answer_text(reply->refusal, out ? (*node)->nearest() : NAN);
}

/// Does not wait.
Result<CanBoardLink::Received*> CanBoardLink::receive(const std::string& channel) {
  const auto node = static_cast<std::uint8_t>(std::stoi(channel));
  Received& received = received_[node];
  if (!received.bus) {
    auto bus = open_bus(bus_, {can_client::tracking_id(node), can_client::measurement_id(node),
                               can_client::status_id(node)});
    if (!bus) return tl::unexpected(bus.error());
    received.bus = std::move(*bus);
  }
  for (hal::CanFrame frame; received.bus->receive(frame) == hal::Status::ok;) {
    if (const auto error_m = can_client::receive_error_m(node, frame)) received.error_m = *error_m;
    if (const auto position_m = can_client::receive_position_m(node, frame))
      received.position_m = *position_m;
    if (const auto progress = can_client::receive_progress(node, frame))
      received.progress = *progress;
  }
  return &received;
}

Result<double> CanBoardLink::error_m(const std::string& channel) {
  return receive(channel).map([](const Received* received) { return received->error_m; });
}

Result<double> CanBoardLink::position_m(const std::string& channel) {
  return receive(channel).map([](const Received* received) { return received->position_m; });
}

Result<double> CanBoardLink::progress(const std::string& channel) {
  return receive(channel).map([](const Received* received) { return received->progress; });
}

std::map<int, std::string> CanBoardLink::controller_kinds(const FrameHistory& frame_history) {
  constexpr std::size_t kind = 0;
  std::map<int, std::string> known;
  for (const auto& [node, place] : active_controllers(frame_history)) {
    const auto value = tuning(std::to_string(node), place, kind, TuningSet::in_use);
    if (value && std::isfinite(*value))
      known[node] = tuning_text(Tuned::controller, control::tunables()[kind], *value);
  }
  return known;
}

BoardLink::Answer CanBoardLink::collect_frames(
    const std::function<std::string(const FrameHistory&)>& describe) {
  auto bus = open_bus(bus_);
  if (!bus) return tl::unexpected(bus.error());
  constexpr double keep_s = 10.0;
  constexpr double default_bit_rate = 500e3;
  FrameHistory frame_history(keep_s, default_bit_rate);
  const Listener listener(std::move(*bus), frame_history);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  return describe(frame_history);
}

BoardLink::Answer CanBoardLink::state() {
  return collect_frames([this](const FrameHistory& frame_history) {
    return state_text(frame_history, controller_kinds(frame_history));
  });
}

BoardLink::Answer CanBoardLink::state_json() {
  return collect_frames([this](const FrameHistory& frame_history) {
    using Json = nlohmann::ordered_json;
    Json state = operating::state_json(frame_history);
    const auto known = controller_kinds(frame_history);
    for (auto& node : state["nodes"]) {
      const auto kind = known.find(node["node"].get<int>());
      node["controller_kind"] = kind == known.end() ? Json(nullptr) : Json(kind->second);
    }
    return state.dump() + "\n";
  });
}

Result<BoardLink::Status> CanBoardLink::status(const std::string& channel) {
  const auto node = static_cast<std::uint8_t>(std::stoi(channel));
  auto bus = open_bus(bus_, {can_client::status_id(node)});
  if (!bus) return tl::unexpected(bus.error());
  for (int i = 0; i < 150; ++i) {
    for (hal::CanFrame frame; (*bus)->receive(frame) == hal::Status::ok;) {
      const auto decoded = can::decode(frame);
      if (!decoded || frame.id != can_client::status_id(node)) continue;
      const auto name_of = [&](const char* signal) {
        const std::size_t place = can::signal_index(*decoded->message, signal);
        return std::string(
            can::value_name(decoded->message->signals[place], decoded->values.at(place)));
      };
      const std::size_t probing = can::signal_index(*decoded->message, "probing");
      return Status{name_of("state"), name_of("fault"), decoded->values.at(probing) == 1.0};
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return failure("no heartbeat from node " + channel + " within 1.5 s");
}

Result<BoardLink::Ending> CanBoardLink::ending(const std::string& channel) {
  const auto node = static_cast<std::uint8_t>(std::stoi(channel));
  auto bus = open_bus(bus_, {can_client::status_id(node), can_client::estimate_id(node)});
  if (!bus) return tl::unexpected(bus.error());
  std::optional<std::string> result;
  std::optional<std::string> notes;
  unsigned friction = 0;  // the estimates have no bit left for it
  for (int i = 0; i < 100 && !(result && notes); ++i) {
    for (hal::CanFrame frame; (*bus)->receive(frame) == hal::Status::ok;) {
      const auto decoded = can::decode(frame);
      if (!decoded) continue;
      const auto value = [&](const char* signal) {
        return decoded->values.at(can::signal_index(*decoded->message, signal));
      };
      if (frame.id == can_client::status_id(node)) {
        const std::size_t place = can::signal_index(*decoded->message, "result");
        result = can::value_name(decoded->message->signals[place], value("result"));
        friction = value("friction") == 1.0 ? note_friction : 0;
      } else if (frame.id == can_client::estimate_id(node) && result) {
        const auto rest = static_cast<unsigned>(value("identify_notes"));
        notes = describe_notes(static_cast<std::uint8_t>(rest | friction), ",");
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (!result) return failure("no heartbeat from node " + channel + " within 1 s");
  return Ending{*result, notes.value_or("")};
}

}  // namespace supercoil::operating
