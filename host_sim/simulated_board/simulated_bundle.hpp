// Muscles of the board that pull one load together.
#pragma once

#include <cstddef>
#include <vector>

#include "plant/bundle_plant.hpp"
#include "simulated_board/muscle_channel.hpp"

namespace supercoil::host_sim {

/// The first channel's position sensor and load_N are the bundle's; the other channels read the
/// same sensor.
class SimulatedBundle final : public SharedMotion {
 public:
  /// The channels must outlive it.
  SimulatedBundle(std::vector<MuscleChannel*> channels, hal::Duration step);

  double position_m(std::size_t) const override { return plant_.position_m(); }
  double temperature_rise_K(std::size_t muscle) const override {
    return plant_.temperature_rise_K(muscle);
  }
  double peak_temperature_rise_K(std::size_t muscle) const override {
    return plant_.peak_temperature_rise_K(muscle);
  }

  /// One step of the board, after all channels have been heated.
  void advance();
  /// Takes over the channels' changed muscles.
  void update() { plant_.set(muscles()); }

 private:
  std::vector<BundledMuscle> muscles() const;

  std::vector<MuscleChannel*> channels_;
  BundlePlant plant_;
  std::vector<double> power_W_;
};

}  // namespace supercoil::host_sim
