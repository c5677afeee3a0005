// What the estimators are given: a muscle under Eq. (18), measured by a sensor.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "estimators/muscle_state.hpp"
#include "plant/linear_plant.hpp"
#include "scenario/reference.hpp"

namespace supercoil::host_sim::estimators {

inline constexpr double tick_s = 1e-3;

struct Trial {
  std::string_view name;
  std::string_view meaning;
  double noise_m = 10e-6;    ///< rms, white
  int bits = 16;             ///< over 40 mm; 0: not quantised
  bool paper_start = false;  ///< θ(0) is the paper's; else each θ is at 60 or 167 % of the truth
  double change_at_s = 100.0;  ///< the stiffness falls from 16 to 12 N/m
  double duration_s = 200.0;

  /// θ(0).
  control::Theta initial() const;
  /// The size of a count; 0 without quantisation.
  double count_m() const {
    return bits > 0 ? 0.040 / static_cast<double>(std::int64_t{1} << bits) : 0.0;
  }
  /// Of the noise that the sensor adds, its rounding counted as white too: rms² · sampling period.
  double noise_density_m2_s() const {
    constexpr double variance_of_rounding = 1.0 / 12.0;
    return (noise_m * noise_m + count_m() * count_m() * variance_of_rounding) * tick_s;
  }
};

/// In the order of the tables.
inline constexpr std::array<Trial, 5> trials{{
    {.name = "nominal", .meaning = "10 µm of noise, 16 bits; softer at 100 s"},
    {.name = "paper_start", .meaning = "the same from the paper's θ(0)", .paper_start = true},
    {.name = "other_phase",
     .meaning = "softer at 115 s",
     .change_at_s = 115.0,
     .duration_s = 215.0},
    {.name = "coarse", .meaning = "12 bits", .bits = 12},
    {.name = "exact", .meaning = "no noise, not quantised", .noise_m = 0.0, .bits = 0},
}};

/// A trial's muscle and sensor, tick by tick.
class Bench {
 public:
  Bench(const Trial& trial, std::uint64_t seed);

  struct Tick {
    double time_s;
    double position_m;  ///< as measured
    double power_W;     ///< that acted since the last tick
  };
  Tick next();
  /// θ of the muscle as it is now.
  const control::Theta& truth() const { return truth_; }
  /// The muscle and its motion as they are now.
  State state() const;
  bool done() const { return ticks_ >= end_; }
  std::int64_t ticks() const { return ticks_; }

 private:
  void soften();

  Trial trial_;
  Reference excitation_ = paper_excitation();
  LinearPlant plant_;
  control::Theta truth_;
  boost::random::mt19937 source_;
  boost::random::normal_distribution<double> noise_;
  std::int64_t ticks_ = 0;
  std::int64_t change_at_;
  std::int64_t end_;
};

}  // namespace supercoil::host_sim::estimators
