// How hot the muscle may be, from everything that is known about it.
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

/// Protection uses the hotter of two observers: the interval observer (configured bounds, and facts
/// measured on purpose) and one with values learned along the way, which can only make it more
/// cautious. After a thermometer reading there are two intervals, and the truth is in both.
class Heat {
 public:
  Heat(const ThermalSettings& settings, const control::PhysicalParameters& muscle, double step_s)
      : settings_(settings),
        air_(settings.air, settings.bounds, step_s),
        interval_(with_weighed_mass(settings), step_s),
        by_reading_(settings.bounds, step_s),
        learned_(settings.thermal_mass_J_per_K, step_s),
        step_s_(step_s),
        expected_{control::ThermalObserver(muscle.thermal_mass_J_per_K, step_s),
                  control::ThermalObserver(settings.bounds.min_mass_J_per_K, step_s),
                  control::ThermalObserver(settings.bounds.max_mass_J_per_K, step_s)} {
    set_muscle(muscle);
    interval_.reset(settings.boot_rise_K);
    by_reading_.reset(settings.boot_rise_K);
    const control::ThermalBounds& b = settings.bounds;
    expected_[1].learn(-b.max_transfer_W_per_K / b.min_mass_J_per_K);
    expected_[2].learn(-1.0 / control::max_time_constant_s(b));
  }

  /// What is known about the muscle's heat from now on. true_over_measured: power, by the senses.
  void set_thermal_facts(const board::ThermalFacts& facts,
                         const PowerBounds::Interval& true_over_measured) {
    const KnownThermalBounds known = known_thermal_bounds(settings_, facts);
    interval_.set(known.bounds, known.known());
    if (facts.has_reading()) {
      const KnownThermalBounds by_reading =
          known_thermal_bounds_by_reading(settings_, facts, true_over_measured);
      by_reading_.set(by_reading.bounds, by_reading.known());
      // What the other interval rules out stays ruled out.
      if (!has_reading_) by_reading_.start_from(interval_);
      true_over_measured_ = true_over_measured;
    }
    has_reading_ = facts.has_reading();
  }

  /// The power since the last tick lies between min_W and max_W; likely_W is the likely value.
  /// sensed: the bounds are those of the measurement and its error.
  void step(double min_W, double max_W, double likely_W, bool sensed = true) {
    interval_.step(min_W, max_W);
    if (has_reading_) {
      by_reading_.step(min_W / true_over_measured_.min,
                       max_W / (sensed ? true_over_measured_.max : true_over_measured_.min));
    }
    learned_.step(max_W);
    for (control::ThermalObserver& expected : expected_)
      expected.step(likely_W);
  }
  /// Called at each tick with the board's air sensor, in °C; never without a sensor.
  void follow_air(const Measured& reading) { air_.step(reading); }
  /// The muscle's thermal pole, as estimated and trusted.
  /// It is clamped to what the configured bounds allow.
  void learn(double pole_rad_per_s) {
    const control::ThermalBounds& b = settings_.bounds;
    learned_.learn(std::fmax(-b.max_transfer_W_per_K / b.min_mass_J_per_K,
                             std::fmin(-1.0 / control::max_time_constant_s(b), pole_rad_per_s)));
  }
  /// Expected positions are those of this muscle from now on, starting cold. A learned pole was the
  /// last one's.
  void set_muscle(const control::PhysicalParameters& muscle) {
    learned_.forget();
    expected_[0] = control::ThermalObserver(muscle.thermal_mass_J_per_K, step_s_);
    expected_[0].learn(muscle.thermal_pole_rad_per_s());
    metres_per_K_ = muscle.force_per_kelvin_N_per_K / muscle.stiffness_N_per_m;
  }

  double coldest_K() const {
    return has_reading_ ? std::max(interval_.min_K(), by_reading_.min_K()) : interval_.min_K();
  }
  double hottest_K() const {
    const double max_K =
        has_reading_ ? std::min(interval_.max_K(), by_reading_.max_K()) : interval_.max_K();
    return std::max(max_K, learned_.rise_K());
  }
  double coldest_C() const { return air_.coldest_C() + coldest_K(); }
  double hottest_C() const { return air_.warmest_C() + hottest_K(); }
  const Air& air() const { return air_; }
  /// Where the muscle should be: as believed, and the fastest and the slowest that the configured
  /// bounds allow, as the belief may be that wrong.
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
  control::RiseIntervalObserver by_reading_;  ///< in measured power
  PowerBounds::Interval true_over_measured_{1.0, 1.0};
  bool has_reading_ = false;
  control::ThermalObserver learned_;
  double step_s_;
  std::array<control::ThermalObserver, 3> expected_;
  double metres_per_K_ = 0.0;
};

}  // namespace supercoil::board
