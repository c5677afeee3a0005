// What is wrong with an input, as JSON.
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "config/diagnostics.hpp"

namespace supercoil {

inline nlohmann::ordered_json problems_json(const Errors& problems) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Error& problem : problems) {
    list.push_back({{"file", problem.file},
                    {"line", problem.line},
                    {"key", problem.key},
                    {"value", problem.value},
                    {"message", problem.message}});
  }
  return {{"problems", list}};
}

}  // namespace supercoil
