// How hot the muscle can be, where its heat transfer is known at some rises better than at others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "supercoil/control/thermal/interval_observer.hpp"

namespace supercoil::control {

/// What is known of η of a muscle whose rise is between two. Colder it may be less, hotter more: as
/// the cube root of the rise, which free convection never exceeds, and radiation not with it as
/// long as it is less than a third (docs/safety.md). It never falls with the rise.
struct TransferSpan {
  double min_W_per_K = 0.0;
  double max_W_per_K = INFINITY;
  double from_K = 0.0;
  double to_K = INFINITY;

  /// The least heat transfer that is possible at this rise >= 0, in W/K.
  double lowest(double rise_K) const {
    return rise_K >= from_K ? min_W_per_K : min_W_per_K * std::cbrt(rise_K / from_K);
  }
  /// The greatest.
  double highest(double rise_K) const {
    return rise_K <= to_K ? max_W_per_K : max_W_per_K * std::cbrt(rise_K / to_K);
  }
};

/// The interval observer with bounds of η for each band of rises. An end goes by the bound at its
/// own rise: a muscle that is beyond that end has no less of it, or no more. The bounds may be set
/// anew at any time; the ends go on from where they are.
class RiseIntervalObserver {
 public:
  /// step_s > 0.
  RiseIntervalObserver(const ThermalBounds& bounds, double step_s) : step_s_(step_s) {
    set(bounds, {});
  }

  /// Within `bounds`, and within each of the spans as far as that leaves anything.
  void set(const ThermalBounds& bounds, std::span<const TransferSpan> spans) {
    for (std::size_t i = 0; i < bands; ++i) {
      double lowest = bounds.min_transfer_W_per_K;
      double highest = bounds.max_transfer_W_per_K;
      const double from_K = band_K * static_cast<double>(i);
      for (const TransferSpan& span : spans) {
        lowest = std::max(lowest, std::min(span.lowest(from_K), bounds.max_transfer_W_per_K));
        // The last band has no end.
        if (i + 1 < bands) highest = std::min(highest, span.highest(from_K + band_K));
      }
      highest = std::max(highest, bounds.min_transfer_W_per_K);
      hot_[i] = hot_end(lowest, no_slower(bounds, lowest), step_s_);
      cold_[i] = cold_end(highest, bounds, step_s_);
    }
  }

  /// min_W, max_W ≥ 0: what was applied since the last tick lies between them.
  void step(double min_W, double max_W) {
    // Where an end moves into another band, the bound must hold in both.
    const std::size_t hot = band(max_K_);
    const double max_K = hot_[hot].moved(max_K_, max_W);
    const std::size_t cooler = band(max_K);
    max_K_ = cooler < hot ? hot_[cooler].moved(max_K_, max_W) : max_K;
    const std::size_t cold = band(min_K_);
    const double min_K = cold_[cold].moved(min_K_, min_W);
    const std::size_t warmer = band(min_K);
    min_K_ = warmer > cold ? cold_[warmer].moved(min_K_, min_W) : min_K;
  }

  /// Temperature rise over ambient.
  double min_K() const { return min_K_; }
  double max_K() const { return max_K_; }

  /// After a start whose history is unknown: anything from 0 to limit_K.
  void reset(double limit_K) {
    min_K_ = 0.0;
    max_K_ = limit_K;
  }
  /// From the ends that another one has reached.
  void start_from(const RiseIntervalObserver& other) {
    min_K_ = other.min_K_;
    max_K_ = other.max_K_;
  }

 private:
  static constexpr std::size_t bands = 100;
  static constexpr double band_K = 2.0;

  /// The greatest mass with which this least heat transfer keeps ψ/η within its bound. One with
  /// more mass has more heat transfer too, and cools no slower (docs/safety.md).
  static ThermalBounds no_slower(ThermalBounds bounds, double lowest_W_per_K) {
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
