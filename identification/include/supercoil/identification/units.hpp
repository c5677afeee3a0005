// Units in laboratory recordings.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace supercoil::identification {

enum class Quantity { time, position, power };

/// The size of this unit in SI; empty: not a unit of this quantity.
std::optional<double> unit_size(Quantity quantity, std::string_view unit);
/// "s, ms, us, min"
std::string units_of(Quantity quantity);

/// To the microsecond, without trailing zeros: a recording's times may count from 1970.
std::string time_text(double time_s);

/// A column's name without its unit, in lower case: "Position (mm)" and "position_mm" are
/// "position" and "mm".
struct NameAndUnit {
  std::string name;
  std::string unit;  ///< empty: no known unit
};
NameAndUnit split_name(Quantity quantity, std::string_view name);

}  // namespace supercoil::identification
