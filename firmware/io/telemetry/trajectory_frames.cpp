#include "telemetry/trajectory_frames.hpp"

#include <algorithm>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"

namespace supercoil::telemetry {

namespace {

namespace message = can::message;

constexpr bool states_have_their_names() {
  for (std::size_t i = 0; i < playback_state_names.size(); ++i) {
    if (can::names_of_playback[i].name != playback_state_names[i]) return false;
  }
  return can::names_of_playback.size() == playback_state_names.size();
}
static_assert(states_have_their_names(), "the states of playback have the same names over CAN");

/// A master sends one Sync a second: a Play that comes after its Sync means the last one or the one
/// before.
constexpr double max_sync_age_s = 2.0;

}  // namespace

TrajectoryFrames::TrajectoryFrames(can::Node first_node, Leases& leases, Loop& loop)
    : first_node_(first_node), leases_(&leases), loop_(&loop), channels_(leases.channels()) {}

TrajectoryFrames::Taken TrajectoryFrames::take(const hal::CanFrame& frame, hal::Time now) {
  if (frame.id == sync_id) take_sync(frame, now);
  const auto to = [&](const can::MessageInfo& message) {
    return can::channel_of(frame, message, first_node_, leases_->channels());
  };
  if (const auto channel = to(message::knot)) return take_knot(*channel, frame, now);
  if (const auto channel = to(message::play)) return take_play(*channel, frame, now);
  return {};
}

TrajectoryFrames::Taken TrajectoryFrames::take_knot(std::uint8_t channel,
                                                    const hal::CanFrame& frame, hal::Time now) {
  const can::Reader<message::knot> m(frame);
  const bool whole = frame.length == message::knot.length;
  const auto is_of = [&](std::uint16_t session) {
    return whole && can::e2e::intact(frame, message::knot.length, session);
  };
  std::uint16_t session = leases_->session(channel);
  const std::uint16_t replaced = leases_->replaced(channel);
  // A master that does not know yet that it was replaced gets an answer; its frame is not damaged.
  if (!is_of(session) && replaced != 0 && is_of(replaced)) session = replaced;
  // While nobody has the lease there is no session to check the frame with: it is only refused.
  if (!whole || (!is_of(session) && leases_->held(channel, now))) return {channel, {}};
  const Header header{channel, answers_knot, m.get<std::uint8_t>("counter"), session};
  const Refusal checked = leases_->check(channel, session, header.counter, now);
  Taken taken;
  if (checked == Refusal::wrong_counter) taken.damaged = channel;
  if (checked != Refusal::none) {
    taken.answer = trajectory_frame(header, checked);
    return taken;
  }
  Command command{channel, Verb::knot, m.get("position_m"), Source::can};
  command.after_s = m.get<float>("after_s");
  command.velocity_m_per_s = m.get<float>("velocity_m_per_s");
  // The first knot of a new trajectory: a start that still waits belongs to the previous one.
  if (command.after_s == 0.0F) channels_[channel].start.reset();
  taken.answer = hand_on(header, command);
  return taken;
}

TrajectoryFrames::Taken TrajectoryFrames::take_play(std::uint8_t channel,
                                                    const hal::CanFrame& frame, hal::Time now) {
  if (!can::e2e::intact(frame, message::play.length)) return {channel, {}};
  const can::Reader<message::play> m(frame);
  const Header header{channel, answers_play, m.get<std::uint8_t>("counter"),
                      m.get<std::uint16_t>("session")};
  Refusal checked = leases_->check(channel, header.session, header.counter, now);
  Taken taken;
  if (checked == Refusal::wrong_counter) taken.damaged = channel;
  const auto when = m.get<std::uint8_t>("when");
  if (checked == Refusal::none && when > never) checked = Refusal::out_of_range;
  if (checked != Refusal::none || when == never) {
    taken.answer = trajectory_frame(header, checked);
    return taken;
  }
  const Start requested{header, m.get<std::uint8_t>("sync"), m.get("after_s")};
  channels_[channel].start.reset();  // that of an earlier Play
  // From an earlier Sync, the start would be over. This order also bounds an after_s that is NaN.
  const hal::Time earliest = now - hal::duration_from(std::min(max_sync_age_s, requested.after_s));
  if (when == at_once) {
    channels_[channel].anchor.reset();
    const double at_s = hal::seconds(frame.received) + requested.after_s;
    taken.answer = hand_on(header, {channel, Verb::start, at_s, Source::can});
  } else if (const auto sync = clock_.find(requested.sync, earliest)) {
    taken.answer = start(requested, *sync);
  } else {
    channels_[channel].start = requested;
    taken.answer = trajectory_frame(header, Refusal::none);
  }
  return taken;
}

void TrajectoryFrames::take_sync(const hal::CanFrame& frame, hal::Time now) {
  if (!can::e2e::intact(frame, message::sync.length)) return;
  const can::Reader<message::sync> m(frame);
  const BusClock::Sync sync{m.get<std::uint8_t>("sync"), m.get("master_time_s"), frame.received};
  clock_.add(sync);
  for (std::size_t place = 0; place < channels_.size(); ++place) {
    Channel& channel = channels_[place];
    const auto i = static_cast<std::uint8_t>(place);
    if (channel.anchor) {
      const BusClock::Sync& anchor = *channel.anchor;
      loop_->channel(i).align_playback(sync.master_s - anchor.master_s -
                                       hal::seconds(sync.received - anchor.received));
    }
    if (!channel.start || channel.start->sync != sync.number) continue;
    const Start waited = *channel.start;
    channel.start.reset();
    // The master knows already that the start waits; the loop may still find it too late.
    if (leases_->held(i, now) && waited.header.session == leases_->session(i)) start(waited, sync);
  }
}

std::optional<hal::CanFrame> TrajectoryFrames::start(const Start& start,
                                                     const BusClock::Sync& sync) {
  channels_[start.header.channel].anchor = sync;
  const double at_s = hal::seconds(sync.received) + start.after_s;
  return hand_on(start.header, {start.header.channel, Verb::start, at_s, Source::can});
}

std::optional<hal::CanFrame> TrajectoryFrames::hand_on(const Header& header, Command command) {
  if (waiting_.full()) return trajectory_frame(header, Refusal::queue_full);
  command.id = waiting_.add(header);
  if (!loop_->send(command)) return trajectory_frame(waiting_.take_back(), Refusal::queue_full);
  return std::nullopt;
}

std::optional<hal::CanFrame> TrajectoryFrames::answered(const Answer& answer) {
  const auto header = waiting_.answered(answer.command.id);
  if (!header) return std::nullopt;
  return trajectory_frame(*header, answer.refusal);
}

std::optional<hal::CanFrame> TrajectoryFrames::changed_playback() {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const PlaybackState now = loop_->channel(i).playback().state;
    if (now == channels_[i].reported) continue;
    channels_[i].reported = now;
    return trajectory_frame({static_cast<std::uint8_t>(i), nothing, 0, 0}, Refusal::none);
  }
  return std::nullopt;
}

hal::CanFrame TrajectoryFrames::trajectory_frame(const Header& header, Refusal refusal) const {
  const PlaybackStatus status = static_cast<const Loop*>(loop_)->channel(header.channel).playback();
  return can::Encoder<message::trajectory>(static_cast<can::Node>(first_node_ + header.channel))
      .set("counter", header.counter)
      .set("answers", header.answers)
      .set("session_low", header.session & 0xFFU)
      .set("refusal", static_cast<double>(refusal))
      .set("playback", static_cast<double>(status.state))
      .set("room", status.room)
      .set("buffered_s", static_cast<double>(status.buffered_s))
      .protected_frame();
}

}  // namespace supercoil::telemetry
