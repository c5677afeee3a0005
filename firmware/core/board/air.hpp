// The air around a muscle, as far as the muscle's temperature can have followed it.
#pragma once

#include <algorithm>
#include <cmath>

#include "supercoil/control/thermal/interval_observer.hpp"

#include "board/measurement.hpp"

namespace supercoil::board {

/// Without a sensor the air lies between these. A reading may be wrong by error_K.
struct AirSettings {
  double warmest_C = 25.0;
  double coldest_C = 15.0;
  double error_K = 0.0;  ///< > 0, of a sensor; 0: no sensor
};

/// A muscle's temperature is its rise, which its power causes, plus the air's, low-pass filtered
/// with the muscle's time constant. Bounds that filter's output: an end follows the air at once if
/// that widens the interval, and with the slowest time constant of the bounds if that narrows it.
class Air {
 public:
  Air(const AirSettings& settings, const control::ThermalBounds& bounds, double step_s)
      : settings_(settings),
        decay_(std::exp(-step_s / control::max_time_constant_s(bounds))),
        warmest_C_(settings.warmest_C),
        coldest_C_(settings.coldest_C) {}

  /// One tick of a board with a sensor; the reading is in °C. One that is beyond the configured
  /// air, absent or NaN, as from a disconnected sensor, can widen the configured interval, not
  /// narrow it.
  void step(const Measured& reading) {
    const double warmest_C = reading.present && reading.value >= settings_.coldest_C
                                 ? reading.value + settings_.error_K
                                 : settings_.warmest_C;
    const double coldest_C = reading.present && reading.value <= settings_.warmest_C
                                 ? reading.value - settings_.error_K
                                 : settings_.coldest_C;
    warmest_C_ = std::max(warmest_C, warmest_C + decay_ * (warmest_C_ - warmest_C));
    coldest_C_ = std::min(coldest_C, coldest_C + decay_ * (coldest_C_ - coldest_C));
  }

  double warmest_C() const { return warmest_C_; }
  double coldest_C() const { return coldest_C_; }
  /// How much warmer than configured.
  double above_configured_K() const { return std::max(0.0, warmest_C_ - settings_.warmest_C); }

 private:
  AirSettings settings_;
  double decay_;  ///< fraction of a difference left after a tick
  double warmest_C_;
  double coldest_C_;
};

}  // namespace supercoil::board
