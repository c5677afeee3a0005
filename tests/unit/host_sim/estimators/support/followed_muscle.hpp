// A simulated muscle that follows a reference under adaptive_ff, as least squares sees it.
#pragma once

#include <array>
#include <cmath>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "plant/plant.hpp"
#include "plant/presets.hpp"

namespace supercoil::test {

enum class Course { sine, steps, random_steps };

/// 10 µm of noise, 16 bits over 40 mm, 1 kHz, a PWM of 12 bits. Times scale with the muscle's
/// thermal time constant: on the paper's muscle the sine has 0.25 rad/s, steps last 20 s and random
/// ones 5 to 30 s.
struct FollowedMuscle {
  static constexpr double step_s = 1e-3;

  control::PhysicalParameters parameters;
  host_sim::PlantEffects effects;
  double max_W = 4.5;
  double min_m = 0.002;
  double max_m = 0.020;
  Course motion = Course::sine;
  unsigned seed = 1;
  control::Theta believed = control::Theta::Ones();  ///< θ(0) over the true θ of `parameters`
  bool detects_changes = true;
  // These act from change_at_s on:
  double change_at_s = 1e9;
  double stiffness_ratio = 1.0;
  double load_N = 0.0;

  double slowness() const {
    return parameters.thermal_mass_J_per_K / parameters.heat_transfer_W_per_K / 1.82;
  }
  control::RegressionScale scale() const {
    return {control::theta_from(parameters), parameters.dc_gain_m_per_W(),
            parameters.moving_mass_kg};
  }
  control::LeastSquaresSettings least_squares() const {
    control::LeastSquaresSettings s;
    s.scale = scale();
    s.initial = s.scale.nominal.cwiseProduct(believed);
    s.max_W = max_W;
    s.detects_changes = detects_changes;
    return s;
  }

  struct Tick {
    double time_s;
    double position_W;  ///< as measured, over the DC gain
    double applied_W;   ///< since the last tick
    double error_m;
    const control::LeastSquaresEstimator<double>& estimator;
  };

  /// on_tick(Tick) is called at each tick and returns whether to continue.
  template <class OnTick>
  void run(double duration_s, OnTick on_tick) const {
    control::LeastSquaresEstimator<double> estimator(least_squares(), step_s);
    control::Controller law(controller(), step_s);
    host_sim::Plant plant(parameters, effects, step_s);
    boost::random::mt19937 source(seed);
    boost::random::normal_distribution<double> noise(0.0, 10e-6);
    Reference reference(*this);
    double power_W = 0.0;
    double carried = 0.0;
    bool limited = false;
    double pull_N = 0.0;
    for (long k = 0; k < std::lround(duration_s / step_s); ++k) {
      const double time_s = static_cast<double>(k) * step_s;
      if (k == std::lround(change_at_s / step_s)) {
        control::PhysicalParameters changed = parameters;
        changed.stiffness_N_per_m *= stiffness_ratio;
        plant.set(changed, effects);
        pull_N = load_N;
      }
      const double measured_m =
          std::nearbyint((plant.position_m() + noise(source)) / count_m) * count_m;
      const double seen_W = measured_m / scale().dc_gain_m_per_W;
      estimator.step(seen_W, power_W);
      law.learn(estimate_of(estimator));
      const auto out = law.step({.reference_m = reference.at(time_s),
                                 .position_m = measured_m,
                                 .applied_power_W = power_W,
                                 .limited = limited,
                                 .range = {0.0, max_W}});
      const double error_m = out.model_m - plant.position_m();
      if (!on_tick(Tick{time_s, seen_W, power_W, error_m, estimator})) return;
      power_W = control::PowerRange{0.0, max_W}.clip(out.demanded_power_W);
      limited = power_W != out.demanded_power_W;
      const double counts = power_W / max_W * pwm_counts + carried;
      carried = counts - std::floor(counts);
      plant.step(std::floor(counts) / pwm_counts * max_W, pull_N);
    }
  }

 private:
  static constexpr double count_m = 0.040 / 65536;
  static constexpr double pwm_counts = 4096.0;

  class Reference {
   public:
    explicit Reference(const FollowedMuscle& muscle)
        : muscle_(muscle), source_(1000 + muscle.seed) {}
    double at(double time_s) {
      const double slow = muscle_.slowness();
      if (muscle_.motion == Course::sine)
        return between(0.5 + 0.5 * std::sin(0.25 * time_s / slow));
      if (muscle_.motion == Course::steps) {
        constexpr std::array<double, 4> parts{1.0 / 6.0, 13.0 / 18.0, 1.0 / 3.0, 1.0};
        return between(parts[static_cast<std::size_t>(time_s / (20.0 * slow)) % parts.size()]);
      }
      if (time_s >= until_s_) {
        until_s_ = time_s + slow * (5.0 + 25.0 * uniform_(source_));
        part_ = uniform_(source_);
      }
      return between(part_);
    }

   private:
    double between(double part) const {
      return muscle_.min_m + part * (muscle_.max_m - muscle_.min_m);
    }
    const FollowedMuscle& muscle_;
    boost::random::mt19937 source_;
    boost::random::uniform_real_distribution<double> uniform_{0.0, 1.0};
    double until_s_ = 0.0;
    double part_ = 0.0;
  };

  control::Estimate estimate_of(const control::LeastSquaresEstimator<double>& estimator) const {
    return {.theta = estimator.parameters().head<4>().cwiseProduct(scale().nominal),
            .settled = estimator.settled(),
            .bias_W = estimator.parameters()[4]};
  }

  control::ControllerSettings controller() const {
    control::ControllerSettings s;
    s.kind = control::ControllerKind::adaptive_ff;
    s.dc_gain_m_per_W = parameters.dc_gain_m_per_W();
    s.adaptive_ff.scale = scale();
    s.adaptive_ff.bandwidth_rad_per_s =
        control::feedback_bandwidth(8.0, scale().nominal, parameters.moving_mass_kg);
    const double slow = std::fmax(1.0, slowness());
    s.model = slow > 1.5 ? control::poles_model({1.0 / slow, 1.0 / slow, 0.8 / slow})
                         : control::design_model();
    return s;
  }
};

/// A muscle with the values of a preset.
inline FollowedMuscle followed(host_sim::MusclePreset preset) {
  const host_sim::PresetMuscle muscle = host_sim::preset_muscle(preset);
  FollowedMuscle f;
  f.parameters = muscle.parameters;
  f.effects = muscle.effects;
  if (preset == host_sim::MusclePreset::b) {
    f.max_W = 2.15;
    f.min_m = 0.001;
    f.max_m = 0.004;
  } else if (preset == host_sim::MusclePreset::c) {
    f.max_W = 3.1;
  }
  return f;
}

/// Time from the true change to the first detected one; infinity: not within 5 s. A detection
/// before the true change counts as minus infinity.
inline double found_after_s(const FollowedMuscle& muscle) {
  double found_s = INFINITY;
  muscle.run(muscle.change_at_s + 5.0, [&](const FollowedMuscle::Tick& tick) {
    if (tick.estimator.changes() == 0) return true;
    found_s =
        tick.time_s < muscle.change_at_s ? -double{INFINITY} : tick.time_s - muscle.change_at_s;
    return false;
  });
  return found_s;
}

}  // namespace supercoil::test
