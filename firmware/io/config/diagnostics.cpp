#include "config/diagnostics.hpp"

namespace supercoil::config {

std::string Problem::text() const {
  std::string result = file;
  if (line > 0) result += ":" + std::to_string(line);
  if (!key.empty()) result += ": " + key;
  if (!value.empty()) result += " = " + value;
  if (of_default) result += " (its default)";
  return result + ": " + message;
}

std::string to_text(const std::vector<Problem>& problems) {
  std::string result;
  for (const Problem& problem : problems)
    result += problem.text() + "\n";
  return result;
}

}  // namespace supercoil::config
