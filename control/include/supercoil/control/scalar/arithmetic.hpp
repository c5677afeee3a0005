// The arithmetics that a controller or an estimator can run in, and the naming of choices.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace supercoil::control {

/// A choice: its values, and their names in configurations.
template <class Value, std::size_t N>
using Names = std::array<std::pair<std::string_view, Value>, N>;

/// Empty when no value has this name; case-sensitive.
template <class Value, std::size_t N>
constexpr std::optional<Value> find_named(const Names<Value, N>& names, std::string_view name) {
  for (const auto& [text, value] : names) {
    if (text == name) return value;
  }
  return std::nullopt;
}

/// "?" when the value has no name.
template <class Value, std::size_t N>
constexpr std::string_view name_of(const Names<Value, N>& names, Value demanded) {
  for (const auto& [text, value] : names) {
    if (value == demanded) return text;
  }
  return "?";
}

/// float64 is double, float32 float, q8_24 the fixed-point type Q8_24.
enum class Arithmetic { float64, float32, q8_24 };

inline constexpr Names<Arithmetic, 3> arithmetic_names{{{"double", Arithmetic::float64},
                                                        {"float", Arithmetic::float32},
                                                        {"q8.24", Arithmetic::q8_24}}};

}  // namespace supercoil::control
