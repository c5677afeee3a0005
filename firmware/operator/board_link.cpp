#include "operator/board_link.hpp"

#include <sstream>
#include <thread>

#include "can_client/decode.hpp"
#include "loop/command_text.hpp"
#include "operator/bus/bus_name.hpp"
#include "operator/monitor/listener.hpp"
#include "operator/monitor/terminal.hpp"
#include "telemetry/frames.hpp"

namespace supercoil::operating {

/// The last word of the channel's line.
BoardLink::Answer LocalLink::result(const std::string& channel) {
  const auto lines = state();
  if (!lines) return tl::unexpected(lines.error());
  std::istringstream text(*lines);
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with(channel + " ")) return line.substr(line.rfind(' ') + 1);
  }
  return tl::unexpected("nothing is known of channel " + channel);
}

CanLink::~CanLink() {
  for (const auto& [node, commander] : nodes_)
    commander->release();
}

BoardLink::Answer CanLink::ask(const std::string& line) {
  const auto command = parse_command(line, telemetry::most_nodes);
  if (!command) return command.error();
  const auto node = static_cast<std::uint8_t>(command->channel + 1);
  if (!nodes_.contains(node)) {
    auto bus = open_bus(bus_, {can_client::acknowledge_id(node)});
    if (!bus) return tl::unexpected(bus.error());
    nodes_.emplace(node, std::make_unique<Commander>(std::move(*bus), node));
  }
  const auto answer = nodes_.at(node)->ask(command->verb, command->value);
  if (!answer) return tl::unexpected(answer.error());
  return answer_text(*answer);
}

BoardLink::Answer CanLink::state() {
  auto bus = open_bus(bus_);
  if (!bus) return tl::unexpected(bus.error());
  constexpr double keep_s = 10.0;
  constexpr double usual_bit_rate = 500e3;
  Recent recent(keep_s, usual_bit_rate);
  const Listener listener(std::move(*bus), recent);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  return state_text(recent);
}

BoardLink::Answer CanLink::result(const std::string& channel) {
  const auto node = static_cast<std::uint8_t>(std::stoi(channel));
  auto bus = open_bus(bus_, {can_client::status_id(node)});
  if (!bus) return tl::unexpected(bus.error());
  for (int i = 0; i < 100; ++i) {
    for (hal::CanFrame frame; (*bus)->receive(frame) == hal::Status::ok;) {
      const auto status = can_client::decode(frame);
      if (!status || frame.id != can_client::status_id(node)) continue;
      const std::size_t place = can_client::signal_index(*status->message, "result");
      const auto& signals = status->message->signals;
      return std::string(can_client::value_name(signals[place], status->values.at(place)));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return tl::unexpected("no heartbeat of node " + channel + " within 1 s");
}

}  // namespace supercoil::operating
