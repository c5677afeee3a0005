#include "storage/codec.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <toml++/toml.h>

#include "storage/envelope.hpp"
#include "storage/fields.hpp"
#include "storage/number.hpp"
#include "storage/tuning_tables.hpp"
#include "text/number_text.hpp"

namespace supercoil::storage {

namespace {

std::string path(const Field& field, unsigned format) {
  return std::string(field.table) + "." + std::string(key_in(field, format));
}

bool is_table(std::string_view name) {
  if (is_tuning_table(name)) return true;
  for (const Field& field : fields) {
    if (field.table == name) return true;
  }
  return false;
}

bool is_field(std::string_view table, std::string_view key, unsigned format) {
  if (is_tuning_key(table, key)) return true;
  for (const Field& field : fields) {
    if (field.table == table && key_in(field, format) == key) return true;
  }
  return false;
}

std::optional<std::string> unknown_key(const toml::table& file, unsigned format) {
  for (const auto& [name, node] : file) {
    if (name == "version") continue;
    const toml::table* table = node.as_table();
    if (table == nullptr || !is_table(name)) return std::string(name.str());
    for (const auto& [key, value] : *table) {
      if (!is_field(name, key, format))
        return std::string(name.str()) + "." + std::string(key.str());
    }
  }
  return std::nullopt;
}

std::optional<std::string> read_version(const toml::node* node, std::uint32_t& version) {
  constexpr std::int64_t max_version = std::numeric_limits<std::uint32_t>::max();
  if (node == nullptr) return "is missing";
  const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!value || *value < 0 || *value > max_version)
    return "must be a whole number, 0 to " + std::to_string(max_version);
  version = static_cast<std::uint32_t>(*value);
  return std::nullopt;
}

Result<board::Learned> read(const toml::table& file, unsigned format) {
  if (const auto key = unknown_key(file, format)) {
    return failure("has a key that this firmware does not know: " + *key);
  }
  board::Learned learned;
  if (const auto wrong = read_version(file.get("version"), learned.version)) {
    return failure("version " + *wrong);
  }
  learned.has_muscle = file.contains("muscle") || file.contains("calibration");
  for (const Field& field : fields) {
    const toml::table* table = file[field.table].as_table();
    const bool left_out = is_optional_table(field.table) ? table == nullptr : !learned.has_muscle;
    if (left_out) continue;
    const toml::node* node = table == nullptr ? nullptr : table->get(key_in(field, format));
    if (const auto wrong = read_number(node, field.of(learned))) {
      return failure(path(field, format) + " " + *wrong);
    }
  }
  if (auto wrong = read_tuning(file, learned.tuning)) return failure(std::move(*wrong));
  if (const auto violation = check(learned)) {
    return failure(std::string(violation->quantity) + " = " + shortest_text(violation->value) +
                   " is out of range: must be " + shortest_text(violation->min) + " to " +
                   shortest_text(violation->max));
  }
  return learned;
}

}  // namespace

std::string encode(const board::Learned& learned) {
  std::string body =
      "# Written by supercoild. An edited file counts as damaged and is not used.\n"
      "version = " +
      std::to_string(learned.version) + "\n";
  board::Learned copy = learned;
  std::string_view table;
  for (const Field& field : fields) {
    if (!is_stored(field, learned)) continue;
    if (field.table != table) body += "\n[" + std::string(field.table) + "]\n";
    table = field.table;
    body += std::string(field.key) + " = " + toml_number(field.of(copy)) + "\n";
  }
  return seal(body + encode_tuning(learned.tuning));
}

Result<board::Learned> decode(std::string_view text) {
  const auto unsealed = unseal(text);
  if (!unsealed) return tl::unexpected(unsealed.error());
  try {
    return read(toml::parse(unsealed->body), unsealed->format);
  } catch (const toml::parse_error& error) {
    return failure("is not valid TOML: " + std::string(error.description()));
  }
}

}  // namespace supercoil::storage
