#include "config/section.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "text/number_text.hpp"

namespace supercoil::config {

namespace {

std::string shown(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string shown(const Range& range) {
  return shown(range.min) + " to " + shown(range.max);
}

std::string joined_path(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

/// The value roughly as its author wrote it: toml++ prints 0.09 as 0.089999999999999997.
std::string shown(const toml::node& node) {
  if (const toml::array* list = node.as_array()) {
    std::string text;
    for (const toml::node& element : *list)
      text += (text.empty() ? "" : ", ") + shown(element);
    return "[" + text + "]";
  }
  if (const auto number = node.as_floating_point()) return shortest_text(number->get());
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  return out.str();
}

bool within(double value, const Range& range) {
  return value >= range.min && value <= range.max;  // false for a NaN
}

std::string list_rule(Range range, std::size_t min_count, std::size_t max_count) {
  const std::string count = min_count == max_count
                                ? std::to_string(min_count)
                                : std::to_string(min_count) + " to " + std::to_string(max_count);
  return "a list of " + count + " numbers, each " + shown(range);
}

}  // namespace

Section::Found Section::lookup(std::string_view key) const {
  const toml::node* own = table_ == nullptr ? nullptr : table_->get(key);
  if (own != nullptr || under_ == nullptr) return {own, false};
  const toml::node* below = under_->get(key);
  return {below, below != nullptr};
}

const toml::node* Section::find(std::string_view key) {
  add_known(key);
  return lookup(key).node;
}

std::string Section::full_key(std::string_view key) const {
  return joined_path(lookup(key).under ? under_path_ : path_, key);
}

int Section::line() const {
  return table_ == nullptr ? line_ : static_cast<int>(table_->source().begin.line);
}

void Section::wrong(std::string_view key, const std::string& message) {
  const toml::node* node = lookup(key).node;
  const int place = node == nullptr ? line() : static_cast<int>(node->source().begin.line);
  const bool has_value = node != nullptr && !node->is_table() && !node->is_array_of_tables();
  diagnostics_->add(place, full_key(key), message, has_value ? shown(*node) : "", node == nullptr);
}

double Section::number(std::string_view key, double fallback, Range range) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_number()) {
    wrong(key, "must be a number, " + shown(range));
    return fallback;
  }
  const double value = *node->value<double>();
  if (within(value, range)) return value;
  wrong(key, "must be " + shown(range));
  return fallback;
}

std::int64_t Section::integer(std::string_view key, std::int64_t fallback, std::int64_t min,
                              std::int64_t max) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  const std::string allowed = std::to_string(min) + " to " + std::to_string(max);
  if (!node->is_integer()) {
    wrong(key, "must be a whole number, " + allowed);
    return fallback;
  }
  const std::int64_t value = *node->value<std::int64_t>();
  if (value >= min && value <= max) return static_cast<std::int64_t>(value);
  wrong(key, "must be " + allowed);
  return fallback;
}

bool Section::flag(std::string_view key, bool fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (node->is_boolean()) return *node->value<bool>();
  wrong(key, "must be true or false");
  return fallback;
}

std::string Section::text(std::string_view key, std::string_view fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::string(fallback);
  if (node->is_string()) return *node->value<std::string>();
  wrong(key, "must be text in quotes");
  return std::string(fallback);
}

std::vector<double> Section::numbers(std::string_view key, std::vector<double> fallback,
                                     Range range, std::size_t min_count, std::size_t max_count) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  const std::string rule = "must be " + list_rule(range, min_count, max_count);
  const toml::array* list = node->as_array();
  if (list == nullptr || list->size() < min_count || list->size() > max_count) {
    wrong(key, rule);
    return fallback;
  }
  std::vector<double> values;
  for (const toml::node& element : *list) {
    if (!element.is_number() || !within(*element.value<double>(), range)) {
      wrong(key, rule + "; " + shown(element) + " is not");
      return fallback;
    }
    values.push_back(*element.value<double>());
  }
  return values;
}

double Section::required_number(std::string_view key, Range range) {
  if (!has(key)) missing_.push_back({std::string(key), "a number, " + shown(range)});
  return number(key, std::numeric_limits<double>::quiet_NaN(), range);
}

std::vector<double> Section::required_numbers(std::string_view key, Range range,
                                              std::size_t min_count, std::size_t max_count) {
  if (!has(key)) missing_.push_back({std::string(key), list_rule(range, min_count, max_count)});
  return numbers(key, {}, range, min_count, max_count);
}

std::int64_t Section::required_integer(std::string_view key, std::int64_t min, std::int64_t max) {
  if (!has(key)) {
    missing_.push_back({std::string(key),
                        "a whole number, " + std::to_string(min) + " to " + std::to_string(max)});
  }
  return integer(key, min, min, max);
}

std::string Section::required_text(std::string_view key) {
  if (!has(key)) missing_.push_back({std::string(key), "text in quotes"});
  std::string given = text(key, "");
  const Found found = lookup(key);
  if (given.empty() && found.node != nullptr && found.node->is_string()) {
    wrong(key, "must not be empty");
  }
  return given;
}

}  // namespace supercoil::config
