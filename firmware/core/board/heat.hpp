// How hot the muscle may be, from everything that is known of it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/thermal/rise_interval_observer.hpp"
#include "supercoil/control/thermal/thermal_observer.hpp"

#include "board/known_heat.hpp"

namespace supercoil::board {

/// Protection uses the hottest of the interval observer (configured bounds, and what was found out
/// on purpose) and of the observer with values that were learned by the way: that can only make it
/// more cautious. Where a thermometer was read there are two intervals, and the truth is in both.
class Heat {
 public:
  Heat(const ThermalSettings& settings, const control::PhysicalParameters& muscle, double step_s)
      : settings_(settings),
        air_(settings.air, settings.bounds, step_s),
        interval_(with_weighed_mass(settings), step_s),
        by_reading_(settings.bounds, step_s),
        learned_(settings.thermal_mass_J_per_K, step_s),
        expected_{control::ThermalObserver(muscle.thermal_mass_J_per_K, step_s),
                  control::ThermalObserver(settings.bounds.lowest_mass_J_per_K, step_s),
                  control::ThermalObserver(settings.bounds.highest_mass_J_per_K, step_s)},
        metres_per_K_(muscle.force_per_kelvin_N_per_K / muscle.stiffness_N_per_m) {
    interval_.reset(settings.boot_rise_K);
    by_reading_.reset(settings.boot_rise_K);
    const control::ThermalBounds& b = settings.bounds;
    expected_[0].learn(muscle.thermal_pole_rad_per_s());
    expected_[1].learn(-b.highest_transfer_W_per_K / b.lowest_mass_J_per_K);
    expected_[2].learn(-b.lowest_transfer_W_per_K / b.highest_mass_J_per_K);
  }

  /// What was found out of the muscle, from now on. true_over_told: power, by the senses.
  void know(const board::HeatFacts& facts, const PowerBounds::Interval& true_over_told) {
    const KnownHeat known = known_heat(settings_, facts);
    interval_.set(known.bounds, known.known());
    if (facts.was_read()) {
      const KnownHeat by_reading = known_heat_by_reading(settings_, facts, true_over_told);
      by_reading_.set(by_reading.bounds, by_reading.known());
      // What the other one rules out is ruled out.
      if (!was_read_) by_reading_.start_from(interval_);
      true_over_told_ = true_over_told;
    }
    was_read_ = facts.was_read();
  }

  /// What acted since the last tick lies between min_W and max_W, and was probably_W.
  /// sensed: the bounds are what the senses tell, and what these may be wrong by.
  void step(double min_W, double max_W, double probably_W, bool sensed = true) {
    interval_.step(min_W, max_W);
    if (was_read_) {
      by_reading_.step(min_W / true_over_told_.min,
                       max_W / (sensed ? true_over_told_.max : true_over_told_.min));
    }
    learned_.step(max_W);
    for (control::ThermalObserver& expected : expected_)
      expected.step(probably_W);
  }
  /// What the board's sensor reads of the air, in °C, at each tick; never, without one.
  void follow_air(const Measured& reading) { air_.step(reading); }
  /// The muscle's thermal pole, as estimated and trusted.
  /// Beyond what the configured bounds allow it is not believed.
  void learn(double pole_rad_per_s) {
    const control::ThermalBounds& b = settings_.bounds;
    learned_.learn(
        std::fmax(-b.highest_transfer_W_per_K / b.lowest_mass_J_per_K,
                  std::fmin(-b.lowest_transfer_W_per_K / b.highest_mass_J_per_K, pole_rad_per_s)));
  }

  double coldest_K() const {
    return was_read_ ? std::max(interval_.lowest_K(), by_reading_.lowest_K())
                     : interval_.lowest_K();
  }
  double hottest_K() const {
    const double highest_K = was_read_ ? std::min(interval_.highest_K(), by_reading_.highest_K())
                                       : interval_.highest_K();
    return std::max(highest_K, learned_.rise_K());
  }
  double coldest_C() const { return air_.coldest_C() + coldest_K(); }
  double hottest_C() const { return air_.warmest_C() + hottest_K(); }
  const Air& air() const { return air_; }
  /// Where the muscle should be: as it is believed, and the fastest and the slowest that the
  /// configured bounds allow. What is only believed may be wrong by as much.
  std::array<double, 3> expected_m() const {
    std::array<double, 3> positions_m{};
    for (std::size_t i = 0; i < expected_.size(); ++i)
      positions_m[i] = expected_[i].rise_K() * metres_per_K_;
    return positions_m;
  }
  double metres_per_K() const { return metres_per_K_; }

 private:
  ThermalSettings settings_;
  Air air_;
  control::RiseIntervalObserver interval_;
  control::RiseIntervalObserver by_reading_;  ///< in power as the senses tell it
  PowerBounds::Interval true_over_told_{1.0, 1.0};
  bool was_read_ = false;
  control::ThermalObserver learned_;
  std::array<control::ThermalObserver, 3> expected_;
  double metres_per_K_;
};

}  // namespace supercoil::board
