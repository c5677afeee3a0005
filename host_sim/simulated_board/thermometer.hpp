// A thermistor on the muscle, or an infrared thermometer that looks at it.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

namespace supercoil::host_sim {

struct ThermometerReading {
  double lag_s = 2.0;  ///< time constant; 0: none
  double offset_K = 0.0;
  double noise_rms_K = 0.0;
  double period_s = 0.1;  ///< between readings

  friend bool operator==(const ThermometerReading&, const ThermometerReading&) = default;
};

/// Follows the muscle's temperature with a lag, and is read periodically.
class Thermometer {
 public:
  /// Begins at the air's temperature.
  Thermometer(const std::optional<ThermometerReading>& settings, double air_C, std::uint64_t seed)
      : at_C_(air_C), generator_(seed) {
    set(settings);
  }
  void set(const std::optional<ThermometerReading>& settings) {
    settings_ = settings;
    if (!settings_) reading_C_ = NAN;
  }

  /// One step, at whose end the muscle has this temperature.
  void step(double muscle_C, double step_s) {
    if (!settings_) return;
    const double part = settings_->lag_s > 0.0 ? -std::expm1(-step_s / settings_->lag_s) : 1.0;
    at_C_ += part * (muscle_C - at_C_);
    // Half a step of tolerance: sums of steps need not be whole.
    const bool due = next_s_ <= 0.5 * step_s;
    next_s_ -= step_s;
    if (!due) return;
    next_s_ += settings_->period_s;
    reading_C_ = at_C_ + settings_->offset_K;
    if (settings_->noise_rms_K > 0.0) reading_C_ += settings_->noise_rms_K * normal_(generator_);
  }

  /// NaN before the first reading and without a thermometer.
  double reading_C() const { return reading_C_; }

 private:
  std::optional<ThermometerReading> settings_;
  double at_C_;
  double reading_C_ = NAN;
  double next_s_ = 0.0;  ///< until the next reading
  boost::random::mt19937_64 generator_;
  boost::random::normal_distribution<double> normal_;
};

}  // namespace supercoil::host_sim
