#include "cli/one_bus.hpp"

#include <string>
#include <utility>

#include "text/number_text.hpp"

namespace supercoil::host_sim {

namespace {

tl::unexpected<Errors> wrong(const std::string& file, const std::string& key,
                             const std::string& value, const std::string& message) {
  return tl::unexpected(Errors{{file, 0, key, message, value}});
}

/// "1", or "1 and 2", or "1 to 4"
std::string nodes_text(const Scenario& board) {
  const int first = board.can.first_node;
  const int last = first + board.channels() - 1;
  if (last == first) return std::to_string(first);
  return std::to_string(first) + (last == first + 1 ? " and " : " to ") + std::to_string(last);
}

/// Shifts the seed by the channels before this board, so that no two boards have the same noise.
void shift_noise(Scenario& board, int channels_before) {
  board.seed += static_cast<std::uint64_t>(channels_before);
}

tl::expected<std::vector<Scenario>, Errors> copies(const RunOptions& options,
                                                   const Scenario& scenario) {
  const int first = scenario.can.first_node;
  const int node_limit = (can::max_nodes + 1 - first) / scenario.channels();
  if (options.nodes > node_limit) {
    return wrong("", "--nodes", std::to_string(options.nodes),
                 "must be 1 to " + std::to_string(node_limit) + ", as the first board is node " +
                     std::to_string(first));
  }
  std::vector<Scenario> boards;
  for (int i = 0; i < options.nodes; ++i) {
    boards.push_back(scenario);
    shift_noise(boards.back(), i * scenario.channels());
    boards.back().can.first_node = static_cast<can::Node>(first + i * scenario.channels());
  }
  return boards;
}

/// What boards in lockstep on one wire must agree on.
tl::expected<void, Errors> check_alike(const std::string& file, const Scenario& board,
                                       const Scenario& first) {
  struct Value {
    const char* key;
    double is;
    double must_be;
  };
  for (const Value& value : {Value{"simulation.rate_Hz", board.rate_Hz, first.rate_Hz},
                             Value{"simulation.duration_s", board.duration_s, first.duration_s},
                             Value{"can.bit_rate", board.can.bit_rate, first.can.bit_rate}}) {
    if (value.is == value.must_be) continue;
    return wrong(file, value.key, number_text(value.is, 9),
                 "must be " + number_text(value.must_be, 9) + ", as in " + first.name +
                     ": the boards of a run share one bus and run in lockstep");
  }
  return {};
}

}  // namespace

std::string name_on_bus(const Scenario& board) {
  return board.name + ", node " + std::to_string(int{board.can.first_node});
}

tl::expected<std::vector<Scenario>, Errors> on_one_bus(const RunOptions& options,
                                                       std::vector<Scenario> scenarios) {
  if (scenarios.size() == 1) return copies(options, scenarios.front());
  int channels = 0;
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    Scenario& board = scenarios[i];
    const bool has_file = !options.boards.empty();
    const std::string& file = has_file ? options.boards[i] : options.scenarios[i];
    if (auto alike = check_alike(file, board, scenarios.front()); !alike)
      return tl::unexpected(std::move(alike.error()));
    if (!has_file) board.can.first_node = static_cast<can::Node>(channels + 1);
    for (std::size_t before = 0; before < i; ++before) {
      const Scenario& other = scenarios[before];
      if (board.can.first_node >= other.can.first_node + other.channels() ||
          other.can.first_node >= board.can.first_node + board.channels())
        continue;
      return wrong(file, "can.first_node", std::to_string(int{board.can.first_node}),
                   "is node " + nodes_text(board) + ", and " + options.boards[before] +
                       " is node " + nodes_text(other) + ": no two boards may have the same node");
    }
    shift_noise(board, channels);
    channels += board.channels();
    if (board.can.first_node + board.channels() - 1 > can::max_nodes) {
      return wrong(file, "", "",
                   "would be node " + nodes_text(board) + ", but the highest node is " +
                       std::to_string(int{can::max_nodes}));
    }
  }
  return scenarios;
}

}  // namespace supercoil::host_sim
