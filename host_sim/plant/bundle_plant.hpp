// Several muscles that pull one load together.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "plant/load_motion.hpp"
#include "plant/muscle_body.hpp"
#include "plant/nonlinear_plant.hpp"

namespace supercoil::host_sim {

/// One muscle of a bundle. The hanging load and the friction belong to the bundle.
struct BundledMuscle {
  control::PhysicalParameters parameters;
  PlantEffects effects;
};

/// The muscles pull in parallel: springs, dampers and forces add up, and each muscle is heated by
/// its own power. Steps like NonlinearPlant, which a bundle of one equals. Moving mass, hanging
/// load, friction and end stops are the first muscle's; each carries an equal share of that load.
class BundlePlant {
 public:
  /// At least one muscle, all valid; step_s > 0, the tick.
  BundlePlant(const std::vector<BundledMuscle>& muscles, double step_s);

  /// One tick. power_W: one value per muscle. load_N stretches the bundle.
  void step(std::span<const double> power_W, double load_N = 0.0);
  /// Replaces the settings of the same number of muscles; their state is kept.
  void set(const std::vector<BundledMuscle>& muscles);

  std::size_t muscles() const { return bodies_.size(); }
  double position_m() const { return load_.position_m(); }
  double velocity_m_per_s() const { return load_.velocity_m_per_s(); }
  double temperature_rise_K(std::size_t muscle) const { return bodies_[muscle].rise_K(); }
  /// The highest rise so far.
  double peak_temperature_rise_K(std::size_t muscle) const { return bodies_[muscle].peak_rise_K(); }

 private:
  void slow_step(std::span<const double> power_W, double load_N);

  SlowSteps slow_;
  std::vector<MuscleBody> bodies_;
  LoadMotion load_;
};

}  // namespace supercoil::host_sim
