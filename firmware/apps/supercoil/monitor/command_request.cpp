#include "apps/supercoil/monitor/command_request.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "telemetry/frames.hpp"
#include "text/command_text.hpp"

namespace supercoil::operating {

namespace {

using nlohmann::json;

Result<std::uint8_t> node_of(const json& read) {
  if (!read.is_object()) return failure("the request must be a JSON object");
  const auto node = read.find("node");
  if (node == read.end() || !node->is_number_integer() || *node < 1 || *node > can::max_nodes) {
    return failure("node must be 1 to " + std::to_string(can::max_nodes));
  }
  return node->get<std::uint8_t>();
}

/// Why a command without a value is not obeyed; empty: it has none.
std::string missing_value(Verb verb) {
  const std::string_view needed =
      verb == Verb::store ? "1 stores the muscle, 0 clears it, 2 stores the tuning, 3 clears it"
                          : needed_value(verb);
  if (needed.empty()) return {};
  return std::string(name(verb)) + " needs a value: " + std::string(needed);
}

json read_json(const std::string& text) {
  return json::parse(text, nullptr, false);
}

}  // namespace

Result<std::uint8_t> parse_node(const std::string& text) {
  return node_of(read_json(text));
}

Result<CommandRequest> parse_command_request(const std::string& text) {
  const json read = read_json(text);
  const auto node = node_of(read);
  if (!node) return tl::unexpected(node.error());
  const std::string opcode = read.contains("opcode") && read["opcode"].is_string()
                                 ? read["opcode"].get<std::string>()
                                 : std::string();
  const auto found = std::find(plain_verb_names.begin() + 1, plain_verb_names.end(), opcode);
  if (found == plain_verb_names.end()) return failure("'" + opcode + "' is not an opcode");
  const auto verb = static_cast<Verb>(std::distance(plain_verb_names.begin(), found));
  double value = 0.0;
  if (const auto given = read.find("value"); given != read.end()) {
    if (!given->is_number() || !std::isfinite(given->get<double>()))
      return failure("value must be a number");
    value = given->get<double>();
    if (std::string problem = value_problem(verb, value); !problem.empty())
      return failure(std::move(problem));
  } else if (std::string missing = missing_value(verb); !missing.empty()) {
    return failure(std::move(missing));
  }
  return CommandRequest{*node, verb, value};
}

}  // namespace supercoil::operating
