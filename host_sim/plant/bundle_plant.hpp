// Several muscles that pull one load together.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "plant/load_motion.hpp"
#include "plant/muscle_body.hpp"
#include "plant/nonlinear_plant.hpp"

namespace supercoil::host_sim {

/// One of them: what hangs from it and what rubs are the bundle's.
struct BundledMuscle {
  control::PhysicalParameters parameters;
  PlantEffects effects;
};

/// Side by side: their springs, dampers and forces add up, and each is as hot as its own power
/// makes it. Steps as NonlinearPlant's, which a bundle of one is. The moving mass, what hangs,
/// friction and end stops are the first muscle's; each carries an equal share of what hangs.
class BundlePlant {
 public:
  /// At least one muscle, all valid; step_s > 0, the tick.
  BundlePlant(const std::vector<BundledMuscle>& muscles, double step_s);

  /// One tick. power_W: of each muscle. load_N pulls the bundle longer.
  void step(std::span<const double> power_W, double load_N = 0.0);
  /// From now on, as many muscles; whatever they remember stays.
  void set(const std::vector<BundledMuscle>& muscles);

  std::size_t muscles() const { return bodies_.size(); }
  double position_m() const { return load_.position_m(); }
  double velocity_m_per_s() const { return load_.velocity_m_per_s(); }
  double temperature_rise_K(std::size_t muscle) const { return bodies_[muscle].rise_K(); }
  /// The hottest that the muscle was.
  double peak_temperature_rise_K(std::size_t muscle) const { return bodies_[muscle].peak_rise_K(); }

 private:
  void slow_step(std::span<const double> power_W, double load_N);

  SlowSteps slow_;
  std::vector<MuscleBody> bodies_;
  LoadMotion load_;
};

}  // namespace supercoil::host_sim
