// What a channel learns about its muscle and keeps over a power cut.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/tracking/tunable.hpp"

namespace supercoil::board {

/// How the channel's measurements relate to this muscle, as `calibrate` found it.
struct Calibration {
  double position_offset_m = 0.0;     ///< measured position of the muscle at rest, −1 to 1
  double position_scale = 1.0;        ///< true displacement over the measured one, 0.1 to 10
  double cold_resistance_Ohm = 10.0;  ///< of the muscle at ambient temperature, 0.01 to 10000

  friend bool operator==(const Calibration&, const Calibration&) = default;
};

/// What a comparison of the channel's senses with a meter found.
struct SenseComparison {
  double supply_gain = 1.0;   ///< true over measured supply voltage, 0.5 to 2
  double current_gain = 1.0;  ///< true over measured current, 0.5 to 2
  double error_ratio = 0.0;   ///< max error of each after its gain, up to 0.2; 0: not compared
  double compared_s = 0.0;    ///< when, in seconds since 1970

  bool compared() const { return error_ratio > 0.0; }
  friend bool operator==(const SenseComparison&, const SenseComparison&) = default;
};

/// What was found out about the muscle's heat in its present place.
struct ThermalFacts {
  double time_constant_s = 0.0;     ///< thermal mass over heat transfer, up to 10000; 0: not known
  double time_constant_at_W = 0.0;  ///< mean power at which it was found, up to 1000
  /// Rise read from a thermometer in steady heat, up to 300; 0: not read.
  double steady_rise_K = 0.0;
  double steady_error_K = 0.0;  ///< error of that reading, up to 100
  double steady_min_W = 0.0;    ///< bounds of the power at that time, by the compared senses
  double steady_max_W = 0.0;

  bool has_time_constant() const { return time_constant_s > 0.0; }
  bool has_reading() const { return steady_rise_K > 0.0; }
  void clear_reading() { steady_rise_K = steady_error_K = steady_min_W = steady_max_W = 0.0; }
  friend bool operator==(const ThermalFacts&, const ThermalFacts&) = default;
};

/// How sure identify was of the muscle that it found, and when.
struct Identification {
  /// Relative standard deviations of θ1 to θ4, up to 10; 0: kept as it was, or not known.
  std::array<double, 4> deviation_ratio{};
  double identified_s = 0.0;  ///< in seconds since 1970; 0: not known

  /// identify always knows the deviation of θ4.
  bool found() const { return deviation_ratio[3] > 0.0; }
  friend bool operator==(const Identification&, const Identification&) = default;
};

/// A std::optional<double> of half the size, as every channel keeps thousands in locked memory. The
/// number put in must not be NaN.
class OptionalNumber {
 public:
  OptionalNumber() = default;
  OptionalNumber(double number) : number_(number) {}
  bool has_value() const { return !std::isnan(number_); }
  explicit operator bool() const { return has_value(); }
  double operator*() const { return number_; }
  friend bool operator==(const OptionalNumber& a, const OptionalNumber& b) {
    return a.number_ == b.number_ || (!a.has_value() && !b.has_value());
  }

 private:
  double number_ = NAN;
};

/// The values of one controller or estimator that were changed on the running board and stored.
struct StoredValues {
  std::array<OptionalNumber, control::tunable_count> values;  ///< empty: as configured

  /// What turns the configured settings into the present ones. Settings:
  /// control::ControllerSettings or EstimatorSettings.
  template <class Settings>
  static StoredValues difference(const Settings& now, Settings configured);
  template <class Settings>
  /// Puts them over configured settings; a value that the kind of law does not have is ignored.
  void apply_to(Settings& configured) const;
  friend bool operator==(const StoredValues&, const StoredValues&) = default;
};

/// In order: the value that each is compared with depends on the kind and model before it.
template <class Settings>
StoredValues StoredValues::difference(const Settings& now, Settings configured) {
  StoredValues stored;
  for (std::size_t i = 0; i < stored.values.size(); ++i) {
    const control::Tunable& tunable = control::tunables()[i];
    const double value = tunable.get(now);
    if (std::isnan(value) || value == tunable.get(configured)) continue;
    stored.values[i] = value;
    tunable.set(configured, value);
  }
  return stored;
}

template <class Settings>
void StoredValues::apply_to(Settings& configured) const {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const control::Tunable& tunable = control::tunables()[i];
    if (values[i] && !std::isnan(tunable.get(configured))) tunable.set(configured, *values[i]);
  }
}

/// What was tuned and chosen on the running board, and stored for the next start.
struct StoredTuning {
  /// By place; controllers and estimators after these cannot be tuned.
  std::array<StoredValues, 4> controllers;
  std::array<StoredValues, 4> estimators;
  std::optional<double> controller;  ///< place of the one chosen at the start
  std::optional<double> estimator;   ///< likewise

  friend bool operator==(const StoredTuning&, const StoredTuning&) = default;
};

/// One whole set. Parameters and calibration belong together: identify measures calibrated
/// positions.
struct Learned {
  control::PhysicalParameters muscle;
  Calibration calibration;
  SenseComparison senses;
  std::uint32_t version = 0;  ///< counts the saves of a channel, from 1; LearnedStore sets it
  /// False: only senses, heat and tuning are known; muscle and calibration mean nothing.
  bool has_muscle = true;
  ThermalFacts heat;
  /// How much of the model's small motions arrives at the sensor, up to 10; 0: not measured.
  double response_ratio = 0.0;
  /// Of the power's variance, not explained by identify's linear model, up to 1; 0: not measured.
  double unexplained_ratio = 0.0;
  Identification identification{};  ///< LearnedStore sets its date
  StoredTuning tuning;

  friend bool operator==(const Learned&, const Learned&) = default;
};

/// From a channel to the storage worker; empty: forget the muscle.
using LearnedUpdate = std::optional<Learned>;

/// Equal in everything but the version.
bool same_content(const Learned& a, const Learned& b);

/// The first quantity that is NaN or out of its range; the muscle's ranges are control::check's.
std::optional<control::Violation> check(const Learned& learned);

}  // namespace supercoil::board
