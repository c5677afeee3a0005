#include "storage/learned.hpp"

#include <array>

namespace supercoil::storage {

bool same_content(const Learned& a, const Learned& b) {
  return a.muscle == b.muscle && a.calibration == b.calibration;
}

std::optional<control::Violation> check(const Learned& learned) {
  if (const auto violation = control::check(learned.muscle)) return violation;
  const Calibration& c = learned.calibration;
  const std::array<control::Violation, 3> rules{{
      {"position_offset_m", c.position_offset_m, -1.0, 1.0},
      {"position_scale", c.position_scale, 0.1, 10.0},
      {"cold_resistance_Ohm", c.cold_resistance_Ohm, 1e-2, 1e4},
  }};
  for (const control::Violation& rule : rules) {
    // Written so that a NaN fails.
    if (!(rule.value >= rule.lowest && rule.value <= rule.highest)) return rule;
  }
  return std::nullopt;
}

}  // namespace supercoil::storage
