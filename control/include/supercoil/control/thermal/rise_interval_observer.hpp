// How hot the muscle can be, when its heat transfer is known better at some rises than at others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "supercoil/control/thermal/interval_observer.hpp"

namespace supercoil::control {

/// Bounds on η while the rise is between from_K and to_K. Below from_K η may be smaller, above to_K
/// larger, as the cube root of the rise. Free convection never changes faster, nor do convection
/// and radiation together while radiation is less than a third of convection (docs/safety.md). η
/// never falls with the rise.
struct TransferSpan {
  double min_W_per_K = 0.0;
  double max_W_per_K = INFINITY;
  double from_K = 0.0;
  double to_K = INFINITY;

  /// The minimum heat transfer possible at this rise >= 0, in W/K.
  double min_at(double rise_K) const {
    return rise_K >= from_K ? min_W_per_K : min_W_per_K * std::cbrt(rise_K / from_K);
  }
  /// The maximum.
  double max_at(double rise_K) const {
    return rise_K <= to_K ? max_W_per_K : max_W_per_K * std::cbrt(rise_K / to_K);
  }
};

/// The interval observer with bounds on η for each band of rises. Each end uses the bound at its
/// own rise: a muscle hotter than the hot end has no less heat transfer, one colder than the cold
/// end no more. The bounds may be changed at any time; the ends continue from their present values.
class RiseIntervalObserver {
 public:
  /// step_s > 0.
  RiseIntervalObserver(const ThermalBounds& bounds, double step_s) : step_s_(step_s) {
    set(bounds, {});
  }

  /// Uses `bounds`, narrowed by each of the spans as far as `bounds` allow.
  void set(const ThermalBounds& bounds, std::span<const TransferSpan> spans) {
    for (std::size_t i = 0; i < bands; ++i) {
      double lowest = bounds.min_transfer_W_per_K;
      double highest = bounds.max_transfer_W_per_K;
      const double from_K = band_K * static_cast<double>(i);
      for (const TransferSpan& span : spans) {
        lowest = std::max(lowest, std::min(span.min_at(from_K), bounds.max_transfer_W_per_K));
        // The last band has no upper end.
        if (i + 1 < bands) highest = std::min(highest, span.max_at(from_K + band_K));
      }
      highest = std::max(highest, bounds.min_transfer_W_per_K);
      hot_[i] = hot_end(lowest, limit_time_constant(bounds, lowest), step_s_);
      cold_[i] = cold_end(highest, bounds, step_s_);
    }
  }

  /// min_W, max_W ≥ 0: the power applied since the last tick lies between them.
  void step(double min_W, double max_W) {
    // When an end moves into another band, the bound must hold in both.
    const std::size_t hot = band(max_K_);
    const double max_K = hot_[hot].next_K(max_K_, max_W);
    const std::size_t cooler = band(max_K);
    max_K_ = cooler < hot ? hot_[cooler].next_K(max_K_, max_W) : max_K;
    const std::size_t cold = band(min_K_);
    const double min_K = cold_[cold].next_K(min_K_, min_W);
    const std::size_t warmer = band(min_K);
    min_K_ = warmer > cold ? cold_[warmer].next_K(min_K_, min_W) : min_K;
  }

  /// Temperature rise over ambient.
  double min_K() const { return min_K_; }
  double max_K() const { return max_K_; }

  /// For a start with unknown history: the rise may be anything from 0 to limit_K.
  void reset(double limit_K) {
    min_K_ = 0.0;
    max_K_ = limit_K;
  }
  /// Continues from the ends of another observer.
  void start_from(const RiseIntervalObserver& other) {
    min_K_ = other.min_K_;
    max_K_ = other.max_K_;
  }

 private:
  static constexpr std::size_t bands = 100;
  static constexpr double band_K = 2.0;

  /// Limits the mass so that this minimum heat transfer keeps ψ/η within its bound. A muscle with
  /// more mass has more heat transfer too, and cools no slower (docs/safety.md).
  static ThermalBounds limit_time_constant(ThermalBounds bounds, double lowest_W_per_K) {
    bounds.max_mass_J_per_K = std::clamp(lowest_W_per_K * bounds.max_time_constant_s,
                                         bounds.min_mass_J_per_K, bounds.max_mass_J_per_K);
    return bounds;
  }
  static std::size_t band(double rise_K) {
    constexpr auto last = static_cast<double>(bands - 1);
    return static_cast<std::size_t>(std::clamp(rise_K / band_K, 0.0, last));
  }

  double step_s_;
  std::array<BasicIntervalEnd<double>, bands> hot_{};
  std::array<BasicIntervalEnd<double>, bands> cold_{};
  double min_K_ = 0.0;
  double max_K_ = 0.0;
};

}  // namespace supercoil::control
