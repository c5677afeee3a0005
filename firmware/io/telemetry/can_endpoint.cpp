#include "telemetry/can_endpoint.hpp"

#include <utility>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"
#include "can/nodes.hpp"
#include "telemetry/opcodes.hpp"
#include "text/program_version.hpp"

namespace supercoil::telemetry {

namespace {

constexpr bool names_agree() {
  for (std::size_t i = 0; i < known_quantities.size(); ++i) {
    if (can::names_of_quantity[i].name != known_quantities[i]) return false;
  }
  return can::names_of_quantity.size() == known_quantities.size();
}
static_assert(names_agree(), "what is known of a muscle has the same names over CAN");

}  // namespace

std::vector<std::uint16_t> received_ids(const CanSettings& settings, std::size_t channels) {
  std::vector<std::uint16_t> ids;
  // Also Status, the heartbeat of every board: it reveals another board with the same node.
  for (const can::MessageInfo& message :
       {can::message::command, can::message::setting_write, can::message::setting_read,
        can::message::tuning_read, can::message::tuning_write, can::message::muscle_read,
        can::message::knot, can::message::play, can::message::status}) {
    for (std::size_t i = 0; i < channels; ++i)
      ids.push_back(can::id_of(message, static_cast<can::Node>(settings.first_node + i)));
  }
  ids.push_back(sync_id);
  return ids;
}

CanEndpoint::CanEndpoint(const CanSettings& settings, const BoardSettings& board, Loop& loop,
                         hal::CanBus& bus, Leases::Random random)
    : loop_(&loop),
      bus_(&bus),
      publisher_(settings, board.channels, loop.timing(), bus),
      leases_(settings.lease_s, board.channels.size(), std::move(random)),
      commands_(settings, leases_),
      settings_(settings, board, leases_, publisher_, loop),
      tuning_(settings.first_node, leases_, loop),
      trajectory_(settings.first_node, leases_, loop),
      first_node_(settings.first_node) {}

void CanEndpoint::answer(const Answer& answer) {
  if (is_of_trajectory(answer.command.verb)) {
    if (const auto frame = trajectory_.answered(answer)) publisher_.send(*frame);
    return;
  }
  const auto frame = commands_.answered(answer);
  if (!frame) return;
  publisher_.send(*frame);
  if (answer.refusal != Refusal::out_of_range) return;
  const Command& command = answer.command;
  publisher_.send(refused_value(static_cast<can::Node>(first_node_ + command.channel),
                                encode_command(command.verb, command.value).value,
                                encode_command(command.verb, answer.nearest).value));
}

void CanEndpoint::poll(hal::Time now) {
  loop_->health().bus.store(bus_->state(), std::memory_order_relaxed);
  receive(now);
  loop_->health().node_conflict.store(now < conflict_until_, std::memory_order_relaxed);
  while (const auto frame = trajectory_.changed_playback())
    publisher_.send(*frame);
  send_boot(now);
  publisher_.poll(now, [&](std::uint8_t channel) { return leases_.held(channel, now); });
}

/// Spread over the period, so that the Boot messages of many channels do not come in a burst.
void CanEndpoint::send_boot(hal::Time now) {
  if (now < next_boot_ || !loop_runs_) return;
  const auto node = static_cast<can::Node>(first_node_ + boot_channel_);
  publisher_.send(boot(node, program_version()));
  loop_runs_ = false;
  boot_channel_ = (boot_channel_ + 1) % leases_.channels();
  next_boot_ = now + boot_period / leases_.channels();
}

bool CanEndpoint::is_own(const hal::CanFrame& frame) const {
  return can::channel_of(frame, can::message::status, first_node_, leases_.channels()).has_value();
}

/// The answer to MuscleRead.
std::optional<hal::CanFrame> CanEndpoint::muscle_answer(const hal::CanFrame& frame) const {
  const can::MessageInfo& request = can::message::muscle_read;
  const auto channel = can::channel_of(frame, request, first_node_, leases_.channels());
  if (!channel || frame.length != request.length) return std::nullopt;
  const auto quantity = can::Reader<can::message::muscle_read>(frame).get<std::uint8_t>("quantity");
  return can::Encoder<can::message::muscle>(static_cast<can::Node>(first_node_ + *channel))
      .set("quantity", quantity)
      .set("value", loop_->channel(*channel).known(quantity))
      .frame();
}

void CanEndpoint::receive(hal::Time now) {
  hal::CanFrame frame;
  for (int i = 0; i < max_batch && bus_->receive(frame) == hal::Status::ok; ++i) {
    if (is_own(frame)) conflict_until_ = now + conflict_lasts;
    const Commands::Taken taken = commands_.take(frame, now);
    if (taken.damaged) loop_->send_damaged(*taken.damaged);
    if (taken.answer) publisher_.send(*taken.answer);
    if (taken.command && !loop_->send(*taken.command)) publisher_.send(commands_.not_taken());
    for (const TakenWrite& write : {settings_.take(frame, now), tuning_.take(frame, now)}) {
      if (write.damaged) loop_->send_damaged(*write.damaged);
      if (write.answer) publisher_.send(*write.answer);
      if (write.refused_value) publisher_.send(*write.refused_value);
    }
    const TrajectoryFrames::Taken moved = trajectory_.take(frame, now);
    if (moved.damaged) loop_->send_damaged(*moved.damaged);
    if (moved.answer) publisher_.send(*moved.answer);
    if (const auto muscle = muscle_answer(frame)) publisher_.send(*muscle);
  }
}

}  // namespace supercoil::telemetry
