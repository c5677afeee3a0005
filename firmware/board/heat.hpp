// How hot the muscle may be, from everything that is known of it.
#pragma once

#include <algorithm>
#include <cmath>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/thermal/interval_observer.hpp"
#include "supercoil/control/thermal/thermal_observer.hpp"

namespace supercoil::board {

/// What is known of the muscle's heat.
struct ThermalSettings {
  control::ThermalBounds bounds{0.13, 0.20, 0.045, 0.18};
  /// Heat in the muscle over electrical power, besides what the senses are wrong by.
  double min_power_ratio = 1.0;
  double max_power_ratio = 1.0;
  double thermal_mass_J_per_K = 0.162;  ///< ψ0, weighed or by calorimetry
  double boot_rise_K = 135.0;           ///< how hot it may be at boot: the history is unknown
  double ambient_C = 25.0;              ///< the warmest that the air can be
  double coldest_ambient_C = 15.0;
};

/// Protection uses the hottest of the interval observer (configured bounds) and of the observer
/// with learned values: learning can only make it more cautious.
class Heat {
 public:
  Heat(const ThermalSettings& settings, const control::PhysicalParameters& muscle, double step_s)
      : settings_(settings),
        interval_(settings.bounds, step_s),
        learned_(settings.thermal_mass_J_per_K, step_s),
        expected_(muscle.thermal_mass_J_per_K, step_s),
        metres_per_K_(muscle.force_per_kelvin_N_per_K / muscle.stiffness_N_per_m) {
    interval_.reset(settings.boot_rise_K);
    expected_.learn(muscle.thermal_pole_rad_per_s());
  }

  /// What acted since the last tick lies between min_W and max_W, and was probably_W.
  void step(double min_W, double max_W, double probably_W) {
    interval_.step(min_W, max_W);
    learned_.step(max_W);
    expected_.step(probably_W);
  }
  /// The muscle's thermal pole, as estimated and trusted.
  /// Beyond what the configured bounds allow it is not believed.
  void learn(double pole_rad_per_s) {
    const control::ThermalBounds& b = settings_.bounds;
    learned_.learn(
        std::fmax(-b.highest_transfer_W_per_K / b.lowest_mass_J_per_K,
                  std::fmin(-b.lowest_transfer_W_per_K / b.highest_mass_J_per_K, pole_rad_per_s)));
  }

  double coldest_K() const { return interval_.lowest_K(); }
  double hottest_K() const { return std::max(interval_.highest_K(), learned_.rise_K()); }
  double coldest_C() const { return settings_.coldest_ambient_C + coldest_K(); }
  double hottest_C() const { return settings_.ambient_C + hottest_K(); }
  /// Where the muscle should be, by what is believed of it.
  double expected_m() const { return expected_.rise_K() * metres_per_K_; }
  double metres_per_K() const { return metres_per_K_; }

 private:
  ThermalSettings settings_;
  control::IntervalObserver interval_;
  control::ThermalObserver learned_;
  control::ThermalObserver expected_;
  double metres_per_K_;
};

}  // namespace supercoil::board
