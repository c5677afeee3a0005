#include "simulated_board/simulated_bundle.hpp"

#include <utility>

namespace supercoil::host_sim {

SimulatedBundle::SimulatedBundle(std::vector<MuscleChannel*> channels, hal::Duration step)
    : channels_(std::move(channels)),
      plant_(muscles(), hal::seconds(step)),
      power_W_(channels_.size()) {
  for (std::size_t i = 0; i < channels_.size(); ++i)
    channels_[i]->join(*this, i);
}

std::vector<BundledMuscle> SimulatedBundle::muscles() const {
  std::vector<BundledMuscle> all;
  for (const MuscleChannel* const channel : channels_)
    all.push_back({channel->settings().plant, channel->settings().effects});
  return all;
}

void SimulatedBundle::advance() {
  for (std::size_t i = 0; i < channels_.size(); ++i)
    power_W_[i] = channels_[i]->true_power_W();
  plant_.step(power_W_, channels_.front()->settings().load_N);
}

}  // namespace supercoil::host_sim
