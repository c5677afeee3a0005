#include "config/key_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "text/number_text.hpp"

namespace supercoil::config {

namespace {

constexpr int key_digits = 9;

struct ValueText {
  std::string operator()(std::monostate) const { return "none"; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return number_text(value, key_digits); }
  std::string operator()(const std::string& value) const { return '"' + value + '"'; }
  template <class Value>
  std::string operator()(const std::vector<Value>& values) const {
    std::string list;
    for (const Value& value : values)
      list += (list.empty() ? "" : ", ") + (*this)(value);
    return "[" + list + "]";
  }
};

using Cells = std::array<std::string, 5>;

Cells cells_of(const Key& key) {
  return {key.name, std::visit(ValueText{}, key.value),
          key.required ? "required" : std::visit(ValueText{}, key.fallback),
          key.line == 0 ? "" : std::to_string(key.line), allowed_text(key)};
}

/// In characters: a unit in a name may have more bytes.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string allowed_text(const Key& key) {
  if (key.type == "flag") return "true, false";
  std::string names;
  for (const std::string& name : key.names)
    names += (names.empty() ? "" : ", ") + name;
  if (!key.range) return names;
  const bool limited = !is_any(*key.range);
  const auto shown = [&key](double limit) {
    return key.type == "integer" ? std::to_string(static_cast<std::int64_t>(limit))
                                 : number_text(limit, key_digits);
  };
  const std::string range = range_text(*key.range, shown(key.range->min), shown(key.range->max));
  if (key.type != "numbers") return limited ? range : "";
  const std::string least = std::to_string(key.min_count);
  const bool fixed = key.min_count == key.max_count;
  return (fixed ? least : least + " to " + std::to_string(key.max_count)) + " numbers" +
         (limited ? ", each " + range : "");
}

std::string to_text(const KeyList& keys) {
  std::vector<Cells> rows{{"key", "value", "default", "line", "allowed"}};
  for (const Key& key : keys)
    rows.push_back(cells_of(key));
  std::array<std::size_t, 5> widths{};
  for (const Cells& cells : rows) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      widths[i] = std::max(widths[i], width_of(cells[i]));
  }
  std::string text;
  for (const Cells& cells : rows) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i)
      line += cells[i] + std::string(widths[i] - width_of(cells[i]) + 2, ' ');
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace supercoil::config
