#include "supercoil/identification/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace supercoil::identification {

namespace {

struct Unit {
  Quantity quantity;
  std::string_view name;
  double size;
};

constexpr std::array units{
    Unit{Quantity::time, "s", 1.0},       Unit{Quantity::time, "ms", 1e-3},
    Unit{Quantity::time, "us", 1e-6},     Unit{Quantity::time, "min", 60.0},
    Unit{Quantity::position, "m", 1.0},   Unit{Quantity::position, "cm", 1e-2},
    Unit{Quantity::position, "mm", 1e-3}, Unit{Quantity::position, "um", 1e-6},
    Unit{Quantity::power, "W", 1.0},      Unit{Quantity::power, "mW", 1e-3},
};

}  // namespace

std::optional<double> unit_size(Quantity quantity, std::string_view unit) {
  if (unit == "µm") unit = "um";
  if (unit == "µs") unit = "us";
  const auto* const found = std::find_if(units.begin(), units.end(), [&](const Unit& u) {
    return u.quantity == quantity && u.name == unit;
  });
  if (found == units.end()) return std::nullopt;
  return found->size;
}

std::string time_text(double time_s) {
  std::string text = std::to_string(time_s);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string units_of(Quantity quantity) {
  std::string result;
  for (const Unit& unit : units) {
    if (unit.quantity != quantity) continue;
    if (!result.empty()) result += ", ";
    result += unit.name;
  }
  return result;
}

NameAndUnit split_name(Quantity quantity, std::string_view name) {
  constexpr std::string_view edges = " _([/";
  const std::size_t closing = name.find_last_not_of(" )]");
  std::string_view open = name.substr(0, closing == std::string_view::npos ? 0 : closing + 1);
  NameAndUnit result;
  const std::size_t edge = open.find_last_of(edges);
  if (edge != std::string_view::npos && edge > 0 && unit_size(quantity, open.substr(edge + 1))) {
    result.unit = open.substr(edge + 1);
    open = open.substr(0, open.find_last_not_of(edges, edge) + 1);
  }
  for (const char c : open)
    result.name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

}  // namespace supercoil::identification
