// How much of a muscle's small motions arrives at its sensor.
#pragma once

#include <cstdint>

#include "supervisor/dither.hpp"

namespace supercoil {

/// Holds the muscle that was found, adds a dither, and compares its answer with the model's.
/// Friction takes most from small motions, and a fit of the large ones does not show it.
class SmallSignal {
 public:
  struct Settings {
    Dither dither;
    double hold_W = 0.0;
    double settle_s = 0.0;  ///< until the muscle is nearly at rest: what drifts slides
    double rate_Hz = 1000.0;
    double step_s = 0.01;
    double noise_m = 0.0;  ///< standard deviation of a step's mean position
  };

  /// motion: of the muscle that was found. The dither must be one that can be decided.
  void start(const Settings& settings, const ExpectedMotion& motion);
  void stop() { place_ = end_; }
  bool running() const { return place_ < end_; }

  /// One tick: this tick's position, and the power applied since the last one. Returns running().
  bool step(double position_m, double applied_W);
  double power_W() const;

  /// Of the last completed run: motion in phase with the model's over the model's, 0.001 to 10, or
  /// 0 if noise hides it.
  double response_ratio() const;

 private:
  void end_step(double position_m, double power_W);

  /// Long enough to know a decided dither's answer to some 3 %, or to 4 % if that takes long.
  static constexpr double measured_s = 4.0;
  static constexpr double long_s = 10.0;
  static constexpr int min_periods = 2;
  static constexpr int enough_periods = 4;

  Settings settings_;
  ExpectedMotion motion_{{}, 0.01};
  detectors::HighPass expected_{dither_corner_rad_per_s, 0.01};
  detectors::HighPass measured_{dither_corner_rad_per_s, 0.01};
  std::int64_t step_ticks_ = 10;
  std::int64_t ticks_ = 0;
  double position_sum_m_ = 0.0;
  double power_sum_W_ = 0.0;
  int place_ = 0;  ///< steps since the start
  int from_ = 0;   ///< of the dither
  int end_ = 0;
  double expected_m2_ = 0.0;
  double shared_m2_ = 0.0;
};

}  // namespace supercoil
