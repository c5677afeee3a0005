#include "telemetry/publisher.hpp"

namespace supercoil::telemetry {

namespace {

/// Answers that wait for the bus, refused values included. Each master waits for an answer before
/// it asks again.
constexpr std::size_t max_answers = 32;

}  // namespace

Publisher::Publisher(const CanSettings& settings, const std::vector<ChannelSettings>& channels,
                     LoopTiming& timing, hal::CanBus& bus)
    : first_node_(settings.first_node),
      channels_(channels.size()),
      schedule_(rates_of(settings, channels)),
      timing_(&timing),
      bus_(&bus),
      emergencies_(8 * channels.size()),
      answers_(max_answers),
      messages_(settings.queue) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const control::PhysicalParameters& muscle = channels[i].muscle;
    const PlaceInJoint& joint = channels[i].joint;
    channels_[i].muscle = {muscle.force_per_kelvin_N_per_K, muscle.moving_mass_kg};
    channels_[i].sent_ns.fill(-1);
    channels_[i].lever = joint.lever;
    if (joint.direction > 0 && joint.has_other()) {
      channels_[i].antagonist =
          static_cast<std::size_t>(static_cast<double>(i) + joint.other_channel_offset);
    }
  }
}

void Publisher::offer(const Row& row) {
  if (row.channel >= channels_.size()) return;
  Channel& channel = channels_[row.channel];
  const bool changed = row.fault != (channel.known ? channel.row.fault : 0);
  channel.row = row;
  channel.multiplexed.take(row);
  channel.known = true;
  if (!changed) return;
  const auto node = static_cast<can::Node>(first_node_ + row.channel);
  push(emergencies_, emergency(node, row));
  if (row.fault != 0 && row.margin_selector == row.fault)
    push(emergencies_, first_cause(node, row));
}

void Publisher::push(Queue& queue, const hal::CanFrame& frame) {
  dropped_ += queue.full() ? 1U : 0U;
  queue.push_back(frame);
}

void Publisher::send(const hal::CanFrame& frame) {
  push(answers_, frame);
}

void Publisher::publish(std::uint8_t index, Message message, bool leased) {
  Channel& channel = channels_[index];
  std::int64_t& sent_ns = channel.sent_ns[static_cast<std::size_t>(message)];
  if (!channel.known || sent_ns == channel.row.time_ns) return;
  sent_ns = channel.row.time_ns;
  push(messages_, frame_of(static_cast<can::Node>(first_node_ + index), channel, message, leased));
}

hal::CanFrame Publisher::frame_of(can::Node node, Channel& channel, Message message, bool leased) {
  const Row& row = channel.row;
  switch (message) {
    case Message::measurement:
      return measurement(node, row);
    case Message::tracking:
      return tracking(node, row);
    case Message::power:
      return power(node, row);
    case Message::heater:
      return heater(node, row);
    case Message::temperature:
      return temperature(node, row);
    case Message::estimate:
      channel.parameter =
          static_cast<std::uint8_t>((channel.parameter + 1) % channel.multiplexed.parameters());
      return estimate(node, row, channel.parameter, channel.muscle, channel.multiplexed);
    case Message::margin:
      return margin(node, row);
    case Message::limit:
      return limit(node, row);
    case Message::gain:
      return gain(node, row);
    case Message::timing:
      return timing(node, take_timing());
    case Message::joint:
      return next_of_joint(node, channel);
    case Message::status:
      break;
  }
  return status(node, row, leased, channel.counter++);
}

hal::CanFrame Publisher::next_of_joint(can::Node node, Channel& agonist) const {
  const auto part = static_cast<JointPart>(agonist.joint_part);
  agonist.joint_part = static_cast<std::uint8_t>((agonist.joint_part + 1) %
                                                 joint_parts(agonist.antagonist.has_value()));
  const Channel* const antagonist = agonist.antagonist ? &channels_[*agonist.antagonist] : nullptr;
  const bool has_antagonist = antagonist != nullptr && antagonist->known;
  return joint(node, part, agonist.lever, agonist.row, has_antagonist ? &antagonist->row : nullptr);
}

BoardTiming Publisher::take_timing() {
  const auto seconds_of = [](std::atomic<std::int64_t>& max_ns) {
    const std::int64_t taken = max_ns.exchange(LoopTiming::none, std::memory_order_relaxed);
    return taken == LoopTiming::none ? NAN : 1e-9 * static_cast<double>(taken);
  };
  return {seconds_of(timing_->late_ns), seconds_of(timing_->execution_ns),
          timing_->overruns.load(std::memory_order_relaxed), dropped_};
}

void Publisher::flush() {
  while (waiting() > 0) {
    Queue& next = !emergencies_.empty() ? emergencies_ : !answers_.empty() ? answers_ : messages_;
    switch (bus_->send(next.front())) {
      case hal::Status::ok:
        next.pop_front();
        break;
      case hal::Status::busy:
      case hal::Status::not_ready:
        return;
      default:
        dropped_ += static_cast<std::uint32_t>(waiting());
        for (Queue* lost : {&emergencies_, &answers_, &messages_})
          lost->clear();
    }
  }
}

}  // namespace supercoil::telemetry
