// The keys that a file may have, as JSON.
#pragma once

#include <type_traits>
#include <variant>

#include <nlohmann/json.hpp>

#include "config/key_list.hpp"

namespace supercoil {

inline nlohmann::ordered_json value_json(const config::KeyValue& value) {
  return std::visit(
      [](const auto& known) -> nlohmann::ordered_json {
        if constexpr (std::is_same_v<std::decay_t<decltype(known)>, std::monostate>) {
          return nullptr;
        } else {
          return known;
        }
      },
      value);
}

inline nlohmann::ordered_json keys_json(const config::KeyList& keys) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const config::Key& key : keys) {
    nlohmann::ordered_json entry{{"key", key.name},
                                 {"type", key.type},
                                 {"value", value_json(key.value)},
                                 {"default", value_json(key.fallback)},
                                 {"required", key.required},
                                 {"line", key.line}};
    // An end that limits nothing is left out.
    if (key.range && key.range->min > config::any_number.min) entry["min"] = key.range->min;
    if (key.range && key.range->max < config::any_number.max) entry["max"] = key.range->max;
    if (key.max_count > 0) {
      entry["min_count"] = key.min_count;
      entry["max_count"] = key.max_count;
    }
    if (!key.names.empty()) entry["names"] = key.names;
    list.push_back(std::move(entry));
  }
  return {{"keys", list}};
}

}  // namespace supercoil
