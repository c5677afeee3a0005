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

/// What is known about the muscle's heat. All numbers but the bounds can only narrow these.
struct ThermalSettings {
  control::ThermalBounds bounds{0.13, 0.20, 0.045, 0.18};
  /// Heat in the muscle over electrical power, besides errors of the senses.
  double min_power_ratio = 1.0;
  double max_power_ratio = 1.0;
  double thermal_mass_J_per_K = 0.162;  ///< ψ0, weighed or by calorimetry
  double mass_error_ratio = 0.0;        ///< of that; 0: it is only believed, and narrows nothing
  /// Error of ψ/η as identify finds it on nonlinear muscles.
  double time_constant_error_ratio = 0.25;
  double thermometer_error_K = 1.0;  ///< of a rise that is read: the difference of two readings
  double boot_rise_K = 135.0;        ///< how hot it may be at boot: the history is unknown
  AirSettings air;

  bool weighed() const { return mass_error_ratio > 0.0; }
};

/// Bounds for an interval observer.
struct KnownThermalBounds {
  control::ThermalBounds bounds;
  std::array<control::TransferSpan, 2> spans{};
  std::size_t count = 0;

  std::span<const control::TransferSpan> known() const { return {spans.data(), count}; }
  /// By the bounds and what each span tells about this rise; never outside of the bounds.
  double min_heat_transfer_W_per_K(double rise_K) const {
    double min_W_per_K = bounds.min_transfer_W_per_K;
    for (const control::TransferSpan& span : known()) {
      min_W_per_K =
          std::max(min_W_per_K, std::min(span.min_at(rise_K), bounds.max_transfer_W_per_K));
    }
    return min_W_per_K;
  }
  /// Likewise.
  double max_heat_transfer_W_per_K(double rise_K) const {
    double max_W_per_K = bounds.max_transfer_W_per_K;
    for (const control::TransferSpan& span : known())
      max_W_per_K = std::min(max_W_per_K, span.max_at(rise_K));
    return std::max(max_W_per_K, bounds.min_transfer_W_per_K);
  }
};

/// The configured bounds, with ψ also within those of what was weighed.
inline control::ThermalBounds with_weighed_mass(const ThermalSettings& s) {
  control::ThermalBounds b = s.bounds;
  if (!s.weighed()) return b;
  const double mass = s.thermal_mass_J_per_K;
  b.min_mass_J_per_K = std::max(b.min_mass_J_per_K, mass * (1.0 - s.mass_error_ratio));
  b.max_mass_J_per_K = std::min(b.max_mass_J_per_K, mass * (1.0 + s.mass_error_ratio));
  return b;
}

/// η = ψ/τ, found while the rise went through a range around its mean.
inline control::TransferSpan by_time_constant(const ThermalSettings& s,
                                              const board::ThermalFacts& facts) {
  constexpr double from_ratio = 0.7;
  constexpr double to_ratio = 1.0;
  const control::ThermalBounds b = with_weighed_mass(s);
  const double error = 1.0 + s.time_constant_error_ratio;
  const double mean_K = facts.time_constant_at_W * facts.time_constant_s / s.thermal_mass_J_per_K;
  return {b.min_mass_J_per_K / facts.time_constant_s / error,
          b.max_mass_J_per_K / facts.time_constant_s * error, from_ratio * mean_K,
          to_ratio * mean_K};
}

/// In true power.
inline KnownThermalBounds known_thermal_bounds(const ThermalSettings& s,
                                               const board::ThermalFacts& facts) {
  KnownThermalBounds known{with_weighed_mass(s)};
  if (s.weighed() && facts.has_time_constant())
    known.spans[known.count++] = by_time_constant(s, facts);
  return known;
}

/// Whether a reading is consistent with what else is known about the muscle.
inline bool is_possible(const KnownThermalBounds& known, const board::ThermalFacts& read,
                        const PowerBounds::Interval& true_over_measured) {
  const double rise_K = read.steady_rise_K;
  const double error_K = read.steady_error_K;
  const double min_W_per_K = read.steady_min_W * true_over_measured.min / (rise_K + error_K);
  const double max_W_per_K =
      read.steady_max_W * true_over_measured.max / std::max(rise_K - error_K, 1e-3);
  return max_W_per_K >= known.min_heat_transfer_W_per_K(rise_K) &&
         min_W_per_K <= known.max_heat_transfer_W_per_K(rise_K);
}

/// In power as measured by compared senses: all quantities are divided by true over measured power.
/// That ratio is unknown, but it was the same when the thermometer was read, so the senses' errors
/// no longer affect the temperature.
inline KnownThermalBounds known_thermal_bounds_by_reading(
    const ThermalSettings& s, const board::ThermalFacts& facts,
    const PowerBounds::Interval& true_over_measured) {
  KnownThermalBounds known = known_thermal_bounds(s, facts);
  control::ThermalBounds& b = known.bounds;
  b.min_mass_J_per_K /= true_over_measured.max;
  b.max_mass_J_per_K /= true_over_measured.min;
  b.min_transfer_W_per_K /= true_over_measured.max;
  b.max_transfer_W_per_K /= true_over_measured.min;
  for (std::size_t i = 0; i < known.count; ++i) {
    known.spans[i].min_W_per_K /= true_over_measured.max;
    known.spans[i].max_W_per_K /= true_over_measured.min;
  }
  const double rise_K = facts.steady_rise_K;
  const double min_K = std::max(rise_K - facts.steady_error_K, 1e-3);
  known.spans[known.count++] = {facts.steady_min_W / (rise_K + facts.steady_error_K),
                                std::max(facts.steady_min_W, facts.steady_max_W) / min_K, rise_K,
                                rise_K};
  return known;
}

}  // namespace supercoil::board
