#include "simulated_board/simulated_board.hpp"

#include <utility>

namespace supercoil::host_sim {

SimulatedBoard::SimulatedBoard(const SimulatedBoardSettings& settings)
    : supply(settings.supply, settings.seed + 2000003),
      pump(hal::duration_from(settings.charge_pump_decay_s)),
      step_(hal::duration_from(1.0 / settings.rate_Hz / settings.substeps)),
      supply_V_(settings.supply_V),
      bundled_(settings.bundles) {
  if (settings.air) air.emplace(*settings.air, settings.seed + 3000017);
  std::uint64_t seed = settings.seed;
  for (const MuscleChannelSettings& channel : settings.channels)
    channels_.push_back(std::make_unique<MuscleChannel>(channel, step_, now_, seed++));
  for (const SimulatedJointSettings& joint : settings.joints) {
    MuscleChannel* antagonist = joint.antagonist ? channels_[*joint.antagonist].get() : nullptr;
    joints_.push_back(
        std::make_unique<SimulatedJoint>(joint, *channels_[joint.agonist], antagonist, step_));
  }
  for (const std::vector<std::size_t>& bundle : bundled_) {
    std::vector<MuscleChannel*> muscles;
    muscles.reserve(bundle.size());
    for (const std::size_t channel : bundle)
      muscles.push_back(channels_[channel].get());
    bundles_.push_back(std::make_unique<SimulatedBundle>(std::move(muscles), step_));
  }
  supply.offer(supply_V_, now_);
}

hal::Time SimulatedBoard::wait_until(hal::Time wake) {
  advance_to(wake + late_);
  late_ = {};
  lost_ = to_lose_;
  to_lose_ = {};
  return now_;
}

void SimulatedBoard::advance_to(hal::Time time) {
  while (now_ + step_ <= time)
    step();
}

void SimulatedBoard::step() {
  closed_ = pump.closed(heartbeat.edges(), now_);
  for (const auto& channel : channels_)
    channel->heat(now_, closed_ ? supply_V_ : 0.0);
  now_ += step_;
  for (const auto& joint : joints_)
    joint->advance();
  for (const auto& bundle : bundles_)
    bundle->advance();
  for (const auto& channel : channels_)
    channel->move(now_);
  supply.offer(supply_V_, now_);
  if (air) air->offer(air_C_, now_);
}

board::Devices SimulatedBoard::devices() {
  board::Devices devices{this, &supply, &heartbeat, &stop_circuit, &light, &watchdog, {}};
  for (const auto& channel : channels_) {
    devices.channels.push_back(
        {&channel->pwm, &channel->enable, &channel->position, &channel->current});
  }
  // The antagonist's channel reads the joint's one sensor, with the opposite sign.
  for (const auto& joint : joints_) {
    const SimulatedJointSettings& its = joint->settings();
    if (its.antagonist)
      devices.channels[*its.antagonist].position = &channels_[its.agonist]->position;
  }
  for (const std::vector<std::size_t>& bundle : bundled_) {
    for (const std::size_t channel : bundle)
      devices.channels[channel].position = &channels_[bundle.front()]->position;
  }
  if (air) devices.air = &*air;
  return devices;
}

}  // namespace supercoil::host_sim
