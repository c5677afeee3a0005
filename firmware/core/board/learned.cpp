#include "board/learned.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace supercoil::board {

bool same_content(const Learned& a, const Learned& b) {
  return a.muscle == b.muscle && a.calibration == b.calibration && a.senses == b.senses &&
         a.has_muscle == b.has_muscle && a.heat == b.heat && a.response_ratio == b.response_ratio &&
         a.unexplained_ratio == b.unexplained_ratio && a.identification == b.identification &&
         a.tuning == b.tuning;
}

namespace {

std::optional<control::Violation> check(const StoredTuning& tuning) {
  for (const auto* all : {&tuning.controllers, &tuning.estimators}) {
    for (const StoredValues& stored : *all) {
      for (std::size_t i = 0; i < stored.values.size(); ++i) {
        const control::Tunable& t = control::tunables()[i];
        if (stored.values[i] && !t.in_range(*stored.values[i]))
          return control::Violation{t.name.data(), *stored.values[i], t.min, t.max};
      }
    }
  }
  constexpr double last_place = 255.0;
  for (const auto& [name, place] :
       {std::pair{"controller", tuning.controller}, std::pair{"estimator", tuning.estimator}}) {
    if (place && !(*place >= 0.0 && *place <= last_place && *place == std::floor(*place)))
      return control::Violation{name, *place, 0.0, last_place};
  }
  return std::nullopt;
}

}  // namespace

std::optional<control::Violation> check(const Learned& learned) {
  if (const auto violation = control::check(learned.muscle)) return violation;
  if (const auto violation = check(learned.tuning)) return violation;
  const Calibration& c = learned.calibration;
  const SenseComparison& s = learned.senses;
  constexpr double year_9999_s = 253'402'300'799.0;
  const ThermalFacts& h = learned.heat;
  const Identification& i = learned.identification;
  const std::array<control::Violation, 20> rules{{
      {"position_offset_m", c.position_offset_m, -1.0, 1.0},
      {"position_scale", c.position_scale, 0.1, 10.0},
      {"cold_resistance_Ohm", c.cold_resistance_Ohm, 1e-2, 1e4},
      {"supply_gain", s.supply_gain, 0.5, 2.0},
      {"current_gain", s.current_gain, 0.5, 2.0},
      {"error_ratio", s.error_ratio, 0.0, 0.2},
      {"compared_s", s.compared_s, 0.0, year_9999_s},
      {"time_constant_s", h.time_constant_s, 0.0, 1e4},
      {"time_constant_at_W", h.time_constant_at_W, 0.0, 1e3},
      {"steady_rise_K", h.steady_rise_K, 0.0, 300.0},
      {"steady_error_K", h.steady_error_K, 0.0, 100.0},
      {"steady_min_W", h.steady_min_W, 0.0, 1e3},
      {"steady_max_W", h.steady_max_W, 0.0, 1e3},
      {"response_ratio", learned.response_ratio, 0.0, 10.0},
      {"unexplained_ratio", learned.unexplained_ratio, 0.0, 1.0},
      {"theta1_deviation_ratio", i.deviation_ratio[0], 0.0, 10.0},
      {"theta2_deviation_ratio", i.deviation_ratio[1], 0.0, 10.0},
      {"theta3_deviation_ratio", i.deviation_ratio[2], 0.0, 10.0},
      {"theta4_deviation_ratio", i.deviation_ratio[3], 0.0, 10.0},
      {"identified_s", i.identified_s, 0.0, year_9999_s},
  }};
  for (const control::Violation& rule : rules) {
    // Written so that a NaN fails.
    if (!(rule.value >= rule.min && rule.value <= rule.max)) return rule;
  }
  return std::nullopt;
}

}  // namespace supercoil::board
