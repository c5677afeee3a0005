// The paper's muscle in open loop under the proof of response, with its sensor and everything that
// can separate the two.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "supervisor/proof.hpp"

namespace supercoil::test {

class HeldMuscle {
 public:
  static constexpr double tick_s = 1e-3;

  explicit HeldMuscle(const ProofSettings& settings, bool known = true,
                      const control::PhysicalParameters& muscle = {}, std::uint64_t seed = 1)
      : proof(settings, muscle, known, 1.0 / tick_s),
        bounds_(settings.thermal.bounds),
        air_C_(settings.thermal.air.warmest_C),
        muscle_(muscle, tick_s),
        heat_(settings.thermal.bounds, tick_s),
        random_(seed) {}

  /// Runs until a fault, but not longer than this.
  void run(double time_s) {
    const double end_s = time_s_ + time_s;
    while (time_s_ + 0.5 * tick_s < end_s && !unanswered)
      tick();
  }

  double demanded_W = 3.0;
  bool off_sensor = false;  ///< from then on also with a quarter of the minimum cooling
  bool present = true;      ///< whether the position is present
  bool heating = true;      ///< a command to heat is in force
  bool obeys = true;        ///< false: more power acts than was allowed
  double hotter_K = 0.0;    ///< how much hotter than its interval says
  double warmer_air_K = 0.0;
  double play_m = 0.0;   ///< friction: the sensor's end follows only beyond this play
  double swing_m = 0.0;  ///< amplitude of a load that swings at 1 Hz
  double moved_m = 0.0;  ///< shift of the position by a new calibration
  double noise_m = 10e-6;
  double power_ratio = 1.05;  ///< true over measured

  Proof proof;
  bool unanswered = false;
  long dither_ticks = 0;
  double min_W = 1e3;   ///< minimum that was allowed
  double peak_W = 0.0;  ///< maximum that was demanded
  /// For a muscle with the minimum mass and cooling.
  double hottest_C() const { return air_C_ + hottest_K_; }

 private:
  void tick() {
    time_s_ += tick_s;
    const double muscle_m = muscle_.step(power_W_);
    if (!off_sensor) end_m_ = std::clamp(end_m_, muscle_m - play_m, muscle_m + play_m);
    heat_.step(power_ratio * power_W_);
    warm();
    const double swing = swing_m * std::sin(6.28 * time_s_);
    const double position_m = end_m_ + moved_m + swing + noise_m * noise_(random_);
    proof.step({power_W_, dither_W_, 1, present, position_m, heat_.max_K() + hotter_K, heating,
                warmer_air_K});
    unanswered = unanswered || proof.unanswered();
    const double requested_W = proof.with_dither_W(demanded_W);
    power_W_ = obeys ? std::min(requested_W, proof.max_W()) : requested_W;
    dither_W_ = power_W_ < requested_W ? 0.0 : proof.dither_W();
    dither_ticks += dither_W_ != 0.0 ? 1 : 0;
    min_W = std::min(min_W, proof.max_W());
    peak_W = std::max(peak_W, requested_W);
  }

  void warm() {
    const double transfer_W_per_K = (off_sensor ? 0.25 : 1.0) * bounds_.min_transfer_W_per_K;
    const double heating_W = power_ratio * power_W_ - transfer_W_per_K * true_K_;
    true_K_ += tick_s / bounds_.min_mass_J_per_K * heating_W;
    hottest_K_ = std::max(hottest_K_, true_K_);
  }

  control::ThermalBounds bounds_;
  double air_C_;
  ExpectedMotion muscle_;
  control::IntervalObserver heat_;
  std::mt19937_64 random_;
  std::normal_distribution<double> noise_;
  double true_K_ = 0.0;
  double hottest_K_ = 0.0;
  double time_s_ = 0.0;
  double end_m_ = 0.0;
  double power_W_ = 0.0;
  double dither_W_ = 0.0;
};

}  // namespace supercoil::test
