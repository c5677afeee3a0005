// Formats the findings of a step for people and programs.
#pragma once

#include <cmath>
#include <string>

#include "apps/common/feasibility_json.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

/// For values received over a bus.
inline constexpr double float_rounding_ratio = 1e-6;

inline std::string in_digits(double value) {
  return number_text(value, 4);
}

/// "9.87 Ohm ± 2 % (configured: 10, -1.3 %)". deviation_ratio: standard; NaN: not known.
inline std::string beside(double found, double configured, const std::string& unit,
                          double deviation_ratio = NAN) {
  const double percent = 100.0 * (found / configured - 1.0);
  const std::string deviation =
      std::isnan(deviation_ratio) ? "" : " ± " + number_text(100.0 * deviation_ratio, 2) + " %";
  return in_digits(found) + (unit.empty() ? "" : " ") + unit + deviation +
         " (configured: " + in_digits(configured) + ", " + (percent < 0.0 ? "" : "+") +
         number_text(percent, 3) + " %)";
}

}  // namespace supercoil::operating
