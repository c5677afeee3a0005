// The measures of an outcome, as tables have them.
#pragma once

#include <array>
#include <string_view>

#include "estimators/bounds.hpp"
#include "estimators/outcome.hpp"

namespace supercoil::host_sim::estimators {

struct Measure {
  std::string_view name;  ///< its unit is the last part
  std::string_view meaning;
  double shown_unit;  ///< tables show the value times this
  control::Theta Outcome::*value;
  control::Theta Bounds::*bound;
};

inline constexpr std::array<Measure, 4> measures{{
    {"to_5_percent_s", "s from rest until the error stays within 5 %, before the change", 1.0,
     &Outcome::to_5_percent_s, &Bounds::to_5_percent_s},
    {"to_1_percent_s", "s from rest until the error stays within 1 %, before the change", 1.0,
     &Outcome::to_1_percent_s, &Bounds::to_1_percent_s},
    {"steady_rms_percent", "% rms, the last 40 s before the change", 100.0, &Outcome::steady_rms,
     &Bounds::steady},
    {"back_to_5_percent_s", "s from the change until the error stays within 5 %", 1.0,
     &Outcome::back_to_5_percent_s, &Bounds::back_to_5_percent_s},
}};

}  // namespace supercoil::host_sim::estimators
