// Bounds of the muscle's heat, from what is configured and what was found out.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "supercoil/control/thermal/rise_interval_observer.hpp"

#include "board/air.hpp"
#include "board/learned.hpp"
#include "board/power_bounds.hpp"

namespace supercoil::board {

/// What is known of the muscle's heat. Each number but the bounds themselves narrows them only.
struct ThermalSettings {
  control::ThermalBounds bounds{0.13, 0.20, 0.045, 0.18};
  /// Heat in the muscle over electrical power, besides what the senses are wrong by.
  double min_power_ratio = 1.0;
  double max_power_ratio = 1.0;
  double thermal_mass_J_per_K = 0.162;  ///< ψ0, weighed or by calorimetry
  double mass_error_ratio = 0.0;        ///< of that; 0: it is only believed, and narrows nothing
  /// Of ψ/η as identify finds it, on muscles that are not linear.
  double time_constant_error_ratio = 0.25;
  double thermometer_error_K = 1.0;  ///< of a rise that is read: the difference of two readings
  double boot_rise_K = 135.0;        ///< how hot it may be at boot: the history is unknown
  AirSettings air;

  bool weighed() const { return mass_error_ratio > 0.0; }
};

/// Bounds for an interval observer.
struct KnownHeat {
  control::ThermalBounds bounds;
  std::array<control::TransferSpan, 2> spans{};
  std::size_t count = 0;

  std::span<const control::TransferSpan> known() const { return {spans.data(), count}; }
  double lowest_W_per_K(double rise_K) const {
    double lowest = bounds.lowest_transfer_W_per_K;
    for (const control::TransferSpan& span : known())
      lowest = std::max(lowest, std::min(span.lowest(rise_K), bounds.highest_transfer_W_per_K));
    return lowest;
  }
  double highest_W_per_K(double rise_K) const {
    double highest = bounds.highest_transfer_W_per_K;
    for (const control::TransferSpan& span : known())
      highest = std::min(highest, span.highest(rise_K));
    return std::max(highest, bounds.lowest_transfer_W_per_K);
  }
};

/// ψ within its configured bounds, and of what was weighed.
inline control::ThermalBounds with_weighed_mass(const ThermalSettings& s) {
  control::ThermalBounds b = s.bounds;
  if (!s.weighed()) return b;
  const double mass = s.thermal_mass_J_per_K;
  b.lowest_mass_J_per_K = std::max(b.lowest_mass_J_per_K, mass * (1.0 - s.mass_error_ratio));
  b.highest_mass_J_per_K = std::min(b.highest_mass_J_per_K, mass * (1.0 + s.mass_error_ratio));
  return b;
}

/// η = ψ/τ. It was found while the rise went through a range around its mean.
inline control::TransferSpan by_time_constant(const ThermalSettings& s,
                                              const board::HeatFacts& facts) {
  constexpr double from_ratio = 0.7;
  constexpr double to_ratio = 1.0;
  const control::ThermalBounds b = with_weighed_mass(s);
  const double error = 1.0 + s.time_constant_error_ratio;
  const double mean_K = facts.time_constant_at_W * facts.time_constant_s / s.thermal_mass_J_per_K;
  return {b.lowest_mass_J_per_K / facts.time_constant_s / error,
          b.highest_mass_J_per_K / facts.time_constant_s * error, from_ratio * mean_K,
          to_ratio * mean_K};
}

/// In power as it is.
inline KnownHeat known_heat(const ThermalSettings& s, const board::HeatFacts& facts) {
  KnownHeat known{with_weighed_mass(s)};
  if (s.weighed() && facts.knows_time_constant())
    known.spans[known.count++] = by_time_constant(s, facts);
  return known;
}

/// Whether a reading may be of the muscle that is known otherwise.
inline bool is_possible(const KnownHeat& known, const board::HeatFacts& read,
                        const PowerBounds::Interval& true_over_told) {
  const double rise_K = read.steady_rise_K;
  const double error_K = read.steady_error_K;
  const double least = read.steady_min_W * true_over_told.min / (rise_K + error_K);
  const double most = read.steady_max_W * true_over_told.max / std::max(rise_K - error_K, 1e-3);
  return most >= known.lowest_W_per_K(rise_K) && least <= known.highest_W_per_K(rise_K);
}

/// In power as the compared senses tell it: all quantities are divided by what the true power is
/// over that. It is not known, but it was the same when the thermometer was read: what the senses
/// err by is no error of the temperature any more.
inline KnownHeat known_heat_by_reading(const ThermalSettings& s, const board::HeatFacts& facts,
                                       const PowerBounds::Interval& true_over_told) {
  KnownHeat known = known_heat(s, facts);
  control::ThermalBounds& b = known.bounds;
  b.lowest_mass_J_per_K /= true_over_told.max;
  b.highest_mass_J_per_K /= true_over_told.min;
  b.lowest_transfer_W_per_K /= true_over_told.max;
  b.highest_transfer_W_per_K /= true_over_told.min;
  for (std::size_t i = 0; i < known.count; ++i) {
    known.spans[i].min_W_per_K /= true_over_told.max;
    known.spans[i].max_W_per_K /= true_over_told.min;
  }
  const double rise_K = facts.steady_rise_K;
  const double least_K = std::max(rise_K - facts.steady_error_K, 1e-3);
  known.spans[known.count++] = {facts.steady_min_W / (rise_K + facts.steady_error_K),
                                std::max(facts.steady_min_W, facts.steady_max_W) / least_K, rise_K,
                                rise_K};
  return known;
}

}  // namespace supercoil::board
