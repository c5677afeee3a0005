#include "operator/board_link.hpp"

#include <thread>

#include "loop/command_text.hpp"
#include "operator/bus/bus_name.hpp"
#include "operator/monitor/listener.hpp"
#include "operator/monitor/terminal.hpp"
#include "telemetry/frames.hpp"

namespace supercoil::operating {

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

}  // namespace supercoil::operating
