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
  return range_text(range, shown(range.min), shown(range.max));
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
  return "a list of " + count + " numbers" + (is_any(range) ? "" : ", each " + shown(range));
}

std::string number_rule(const Range& range) {
  return is_any(range) ? "a number" : "a number, " + shown(range);
}

/// monostate: a table, or what no reader accepts.
KeyValue value_of(const toml::node& node) {
  if (const auto number = node.value_exact<std::int64_t>()) return *number;
  if (const auto number = node.value_exact<double>()) return *number;
  if (const auto flag = node.value_exact<bool>()) return *flag;
  if (auto text = node.value_exact<std::string>()) return std::move(*text);
  std::vector<double> numbers;
  std::vector<std::string> texts;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) {
      const auto text = element.value_exact<std::string>();
      texts.push_back(text ? *text : shown(element));
      if (element.is_number()) numbers.push_back(*element.value<double>());
    }
  }
  if (numbers.size() < texts.size()) return texts;
  return numbers;
}

/// A reader's mark for a key without a default or value.
bool is_none(const KeyValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return !std::isfinite(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return text->empty();
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) return texts->empty();
  const auto* list = std::get_if<std::vector<double>>(&value);
  return list != nullptr && list->empty();
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

void Section::note(std::string_view key, Key known) const {
  KeyList* keys = diagnostics_->keys();
  if (keys == nullptr) return;
  const toml::node* node = lookup(key).node;
  known.name = joined_path(path_, key);
  known.value = node == nullptr ? known.fallback : value_of(*node);
  known.line = node == nullptr ? 0 : static_cast<int>(node->source().begin.line);
  for (KeyValue* value : {&known.fallback, &known.value}) {
    if (is_none(*value)) *value = std::monostate();
  }
  keys->push_back(std::move(known));
}

void Section::require(std::string_view key, std::string rule) {
  if (!has(key)) missing_.push_back({std::string(key), std::move(rule)});
  if (KeyList* keys = diagnostics_->keys()) {
    keys->back().required = true;
    keys->back().fallback = std::monostate();
  }
}

std::optional<std::int64_t> Section::optional_integer(std::string_view key, std::int64_t min,
                                                      std::int64_t max) {
  const std::int64_t none = min - 1;
  const std::int64_t value = integer(key, none, min, max);
  if (KeyList* keys = diagnostics_->keys()) {
    keys->back().fallback = std::monostate();
    if (!has(key)) keys->back().value = std::monostate();
  }
  return value == none ? std::nullopt : std::optional(value);
}

double Section::number(std::string_view key, double fallback, Range range) {
  note(key, {.type = "number", .fallback = fallback, .range = range});
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_number()) {
    wrong(key, "must be " + number_rule(range));
    return fallback;
  }
  const double value = *node->value<double>();
  if (within(value, range)) return value;
  wrong(key, "must be " + shown(range));
  return fallback;
}

std::int64_t Section::integer(std::string_view key, std::int64_t fallback, std::int64_t min,
                              std::int64_t max) {
  note(key, {.type = "integer",
             .fallback = fallback,
             .range = Range{static_cast<double>(min), static_cast<double>(max)}});
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
  note(key, {.type = "flag", .fallback = fallback});
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (node->is_boolean()) return *node->value<bool>();
  wrong(key, "must be true or false");
  return fallback;
}

std::string Section::text(std::string_view key, std::string_view fallback) {
  note(key, {.type = "text", .fallback = std::string(fallback)});
  const toml::node* node = find(key);
  if (node == nullptr) return std::string(fallback);
  if (node->is_string()) return *node->value<std::string>();
  wrong(key, "must be text in quotes");
  return std::string(fallback);
}

std::string Section::one_of(std::string_view key, std::string_view fallback,
                            std::vector<std::string> names) {
  if (key == "kind" && !has(key)) default_kind_ = fallback;
  std::string given = text(key, fallback);
  const bool allowed = !has(key) || std::ranges::find(names, given) != names.end();
  if (!allowed) {
    std::string all;
    for (const std::string& name : names)
      all += (all.empty() ? "" : ", ") + name;
    wrong(key, "must be one of: " + all);
    given = fallback;
  }
  if (KeyList* keys = diagnostics_->keys()) keys->back().names = std::move(names);
  return given;
}

std::vector<double> Section::numbers(std::string_view key, std::vector<double> fallback,
                                     Range range, std::size_t min_count, std::size_t max_count) {
  note(key, {.type = "numbers",
             .fallback = fallback,
             .range = range,
             .min_count = min_count,
             .max_count = max_count});
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

std::vector<std::string> Section::texts(std::string_view key) {
  note(key, {.type = "texts"});
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  std::vector<std::string> found;
  const auto add = [&](const toml::node& one) {
    const auto text = one.value_exact<std::string>();
    if (!text || text->empty()) return false;
    found.push_back(*text);
    return true;
  };
  const toml::array* list = node->as_array();
  const bool right = list == nullptr ? add(*node) : std::all_of(list->begin(), list->end(), add);
  if (!right) wrong(key, "must be a name or a list of names");
  if (KeyList* keys = diagnostics_->keys()) keys->back().value = found;
  return found;
}

std::optional<double> Section::optional_number(std::string_view key, Range range) {
  const double value = number(key, std::numeric_limits<double>::quiet_NaN(), range);
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

double Section::required_number(std::string_view key, Range range) {
  const double value = number(key, std::numeric_limits<double>::quiet_NaN(), range);
  require(key, number_rule(range));
  return value;
}

std::vector<double> Section::required_numbers(std::string_view key, Range range,
                                              std::size_t min_count, std::size_t max_count) {
  std::vector<double> values = numbers(key, {}, range, min_count, max_count);
  require(key, list_rule(range, min_count, max_count));
  return values;
}

std::int64_t Section::required_integer(std::string_view key, std::int64_t min, std::int64_t max) {
  const std::int64_t value = integer(key, min, min, max);
  require(key, "a whole number, " + std::to_string(min) + " to " + std::to_string(max));
  return value;
}

std::string Section::required_text(std::string_view key) {
  std::string given = text(key, "");
  require(key, "text in quotes");
  const Found found = lookup(key);
  if (given.empty() && found.node != nullptr && found.node->is_string()) {
    wrong(key, "must not be empty");
  }
  return given;
}

toml::array Section::required_values(std::string_view key) {
  note(key, {.type = "values"});
  const std::string rule = "a list of numbers, texts, true or false";
  require(key, rule);
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const auto is_value = [](const toml::node& one) {
    return one.is_number() || one.is_string() || one.is_boolean();
  };
  const toml::array* list = node->as_array();
  if (list != nullptr && !list->empty() && std::all_of(list->begin(), list->end(), is_value))
    return *list;
  wrong(key, "must be " + rule);
  return {};
}

}  // namespace supercoil::config
