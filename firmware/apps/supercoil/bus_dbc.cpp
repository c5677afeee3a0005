#include "apps/supercoil/bus_dbc.hpp"

#include <array>
#include <charconv>

namespace supercoil::operating {

namespace {

constexpr std::string_view board_node = "Board";

/// The text with its first `old` replaced; unchanged if it has none.
std::string with(std::string_view text, std::string_view old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  std::string result(text);
  return at == std::string_view::npos ? result : result.replace(at, old.size(), replacement);
}

std::string named(std::string_view name, int node) {
  return std::string(name) + "_" + std::to_string(node);
}

/// The position of a message's identifier in a line of the DBC's sections; npos: none.
std::size_t identifier_in(std::string_view line) {
  static constexpr std::array<std::string_view, 5> before{"BO_ ", "CM_ BO_ ", "CM_ SG_ ", "VAL_ ",
                                                          "SIG_VALTYPE_ "};
  for (const std::string_view prefix : before) {
    if (line.starts_with(prefix)) return prefix.size();
  }
  constexpr std::string_view of_message = "\" BO_ ";
  const std::size_t at = line.find(of_message);
  return line.starts_with("BA_ ") && at != std::string_view::npos ? at + of_message.size()
                                                                  : std::string_view::npos;
}

std::string of_node(std::string_view line, std::size_t at, int node) {
  int identifier = 0;
  const char* const digits = line.data() + at;
  const char* const end = std::from_chars(digits, line.data() + line.size(), identifier).ptr;
  std::string result(line.substr(0, at));
  result += std::to_string(identifier + node - 1);
  result += std::string_view(end, line.data() + line.size());
  if (!line.starts_with("BO_ ")) return result;
  result = with(result, ":", named("", node) + ":");
  return result.ends_with(board_node) ? result + named("", node) : result;
}

/// A message with its signals, once for each node.
std::string message(std::string_view block, const std::vector<int>& nodes) {
  std::string result;
  for (const int node : nodes) {
    for (std::string_view rest = block; !rest.empty();) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(line.size() + 1);
      const bool is_received_by_board = line.starts_with(" SG_") && line.ends_with(board_node);
      result +=
          line.starts_with("BO_ ") ? of_node(line, identifier_in(line), node) : std::string(line);
      result += is_received_by_board ? named("", node) + "\n" : "\n";
    }
    result += '\n';
  }
  return result;
}

}  // namespace

std::string bus_dbc(std::string_view dbc, const std::vector<int>& nodes) {
  std::string result;
  while (!dbc.empty()) {
    const std::string_view line = dbc.substr(0, dbc.find('\n'));
    if (line.starts_with("BO_ ")) {
      const std::size_t end = dbc.find("\n\n") + 1;
      result += message(dbc.substr(0, end), nodes);
      dbc.remove_prefix(end + 1);
      continue;
    }
    dbc.remove_prefix(line.size() + 1);
    const std::size_t at = identifier_in(line);
    if (line.starts_with("BU_:")) {
      std::string boards;
      for (const int node : nodes)
        boards += (boards.empty() ? "" : " ") + named(board_node, node);
      result += with(line, board_node, boards) + "\n";
    } else if (line.starts_with("CM_ BU_ Board ")) {
      for (const int node : nodes)
        result += with(line, board_node, named(board_node, node)) + "\n";
    } else if (at != std::string_view::npos) {
      for (const int node : nodes)
        result += of_node(line, at, node) + "\n";
    } else {
      result += std::string(line) + "\n";
    }
  }
  return result;
}

}  // namespace supercoil::operating
