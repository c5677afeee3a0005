#include "storage/number.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace supercoil::storage {

std::string shown(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string number_text(double value) {
  const std::string text = shown(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::optional<std::string> read_number(const toml::node* node, double& value) {
  if (node == nullptr) return "is missing";
  if (!node->is_number()) return "is not a number";
  value = *node->value<double>();
  if (!std::isfinite(value)) return "is " + shown(value) + ", which is not a finite number";
  return std::nullopt;
}

}  // namespace supercoil::storage
