#include "storage/number.hpp"

#include <cmath>

#include "text/number_text.hpp"

namespace supercoil::storage {

std::string toml_number(double value) {
  const std::string text = shortest_text(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::optional<std::string> read_number(const toml::node* node, double& value) {
  if (node == nullptr) return "is missing";
  if (!node->is_number()) return "is not a number";
  value = *node->value<double>();
  if (!std::isfinite(value)) return "is " + shortest_text(value) + ", which is not a finite number";
  return std::nullopt;
}

}  // namespace supercoil::storage
