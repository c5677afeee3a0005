#include "loop/channel.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace supercoil {

namespace {

/// Longer than all hold times at 1 kHz but the slowest; this many overruns are a fault by
/// themselves.
constexpr std::int64_t max_repeats = 1000;

/// 2³²/φ: steps of the golden ratio are spread evenly even if a reader, such as telemetry, sees
/// only every n-th; with a counter, every fifth row would show only a fifth of the detectors.
constexpr std::uint32_t golden_ratio = 2654435769U;

}  // namespace

Channel::Channel(const ChannelSettings& settings, const BoardSettings& board,
                 const board::ChannelDevices& devices, std::uint8_t index)
    : index_(index),
      axis_(settings, board, devices, state_),
      tuner_(settings, board.step_s()),
      supervisor_(settings.supervision, settings.heater.cold_resistance_Ohm,
                  board.supervision.min_supply_V, settings.heater.sense_filter_s, board.step_s()) {}

void Channel::add_tuning(Command& command) {
  control::PhysicalParameters muscle;
  std::size_t quantity = 0;
  for (const control::PhysicalRange& range : control::physical_ranges)
    muscle.*range.member = known(quantity++);
  tuner_.add_to(command, muscle);
}

void Channel::sample(hal::Time now) {
  reset_requested_ = false;
  axis_.sample(now);
}

void Channel::supervise(const BoardTick& board) {
  axis_.observe(board.supply_V, board.air, board.periods);
  const AxisInputs& axis = axis_.inputs();
  const HeaterInputs& heater = axis_.heater().inputs(state_);
  commands_.heating = state_.may_heat();
  // A led channel depends on its leader's renewal alone.
  commands_.renewed = commands_.renewed || led();
  present_fault_ = supervisor_.step(axis, heater, commands_);
  // Skipped periods count too: in them nothing was renewed and nothing was heard.
  axis_.clear_events();
  commands_ = {.heating = commands_.heating};
  const std::int64_t more = std::min(board.periods, max_repeats);
  for (std::int64_t i = 1; i < more && present_fault_ == Fault::none; ++i)
    present_fault_ = supervisor_.step(axis, heater, commands_);
  if (!supervisor_.inside(axis.sensor_m)) axis_.reject_position();

  const Fault cause = board.fault != Fault::none ? board.fault : present_fault_;
  if (cause != Fault::none && !board.testing) {
    disarm(cause, board.fault != Fault::none ? board.margin : supervisor_.verdict().margin(cause));
  }
  if (!reset_requested_) {
    state_.reset(false, true);
    group_reset_.reset();
  }
  // If the supervisor rejects the probed resistance, the channel has been made safe by now.
  if (axis_.end_probe() && !hand_over(Mode::calibrate)) state_.rest();
}

void Channel::control() {
  if (waits_for_others()) return follow_others();
  const bool moved_together = moves_together();
  const Mode mode = axis_.mode();
  if (!axis_.control() || hand_over(mode)) return;
  state_.rest();
  if (!moved_together) return;
  for (Channel* const other : others_)
    other->rest_now();
}

void Channel::disarm(Fault cause, const detectors::Margin& margin) {
  make_safe(cause, margin);
  for (Channel* const other : others_)
    other->make_safe(cause, margin);
}

void Channel::make_safe(Fault cause, const detectors::Margin& margin) {
  if (state_.state() != State::fault) {
    first_margin_ = margin;
    cause_is_new_ = cause != Fault::none;
  }
  abandon_others();
  group_reset_.reset();
  state_.disarm(cause);
  axis_.disarm();
}

const Snapshot& Channel::publish(const BoardTick& board, const Verdict& board_verdict) {
  Snapshot& s = snapshot_;
  s.time = board.time;
  s.channel = index_;
  s.state = state_.state();
  s.fault = state_.first_cause();
  selector_ += golden_ratio;
  axis_.publish(selector_, s);
  publish_group(s);
  const auto& faults = all_faults();
  s.margin_selector = faults[(std::uint64_t{selector_} * faults.size()) >> 32U].fault;
  const Verdict& judge =
      board_verdict.judges(s.margin_selector) ? board_verdict : supervisor_.verdict();
  s.margin = judge.margin(s.margin_selector);
  // The first row that shows the fault carries the margin of its first cause, out of turn.
  if (std::exchange(cause_is_new_, false)) {
    s.margin_selector = s.fault;
    s.margin = first_margin_;
  }
  return s;
}

Reply Channel::answer(const Command& command, const BoardTick& board) {
  const Reply reply = obey(command, board);
  // Only an obeyed command ends a run of damaged or refused ones.
  if (reply.refusal == Refusal::wrong_state) commands_.refused = true;
  if (reply.refusal == Refusal::none) commands_.obeyed = true;
  return reply;
}

Reply Channel::obey(const Command& command, const BoardTick& board) {
  switch (command.verb) {
    case Verb::arm:
      return arm(board);
    case Verb::disarm:
      disarm(Fault::none);
      return Refusal::none;
    case Verb::reset:
      return reset(board);
    case Verb::position:
      return heat(Mode::position, command.value, board);
    case Verb::power:
      return heat(Mode::power, command.value, board);
    case Verb::identify:
      return heat(Mode::identify, 0.0, board);
    case Verb::calibrate:
      return heat(Mode::calibrate, 0.0, board);
    case Verb::renew:
      return renew();
    case Verb::rest:
      return rest();
    case Verb::knot:
    case Verb::start:
      return play(command);
    default:
      return axis_.obey(command);
  }
}

Refusal Channel::may_arm(const BoardTick& board) const {
  if (state_.state() != State::disarmed) return Refusal::wrong_state;
  const bool quiet = present_fault_ == Fault::none && board.fault == Fault::none;
  return board.proven && quiet && axis_.ready() ? Refusal::none : Refusal::not_ready;
}

Refusal Channel::arm(const BoardTick& board) {
  if (const Refusal own = may_arm(board); own != Refusal::none) return own;
  for (const Channel* const other : others_) {
    if (const Refusal others = other->may_arm(board); others != Refusal::none) return others;
  }
  for (Channel* const other : others_)
    other->arm_now();
  arm_now();
  return Refusal::none;
}

void Channel::arm_now() {
  state_.arm();
  axis_.heater().start_probe();
}

Refusal Channel::reset(const BoardTick& board) {
  reset_requested_ = true;
  if (const auto answered = std::exchange(group_reset_, std::nullopt)) return *answered;
  bool persists = present_fault_ != Fault::none || board.fault != Fault::none;
  for (const Channel* const other : others_)
    persists = persists || other->present_fault_ != Fault::none;
  for (Channel* const other : others_) {
    other->reset_requested_ = true;
    const Refusal answer = other->state_.reset(true, persists);
    if (answer != Refusal::no_edge) other->group_reset_ = answer;
  }
  return state_.reset(true, persists);
}

Refusal Channel::may_heat(const BoardTick& board) const {
  const State state = state_.state();
  if (state != State::armed && state != State::active) return Refusal::wrong_state;
  if (!board.proven) return Refusal::not_ready;
  const bool probes = state == State::armed && axis_.heater().probing();
  return probes ? Refusal::busy : Refusal::none;
}

Reply Channel::heat(Mode mode, double value, const BoardTick& board) {
  const bool of_joint = !others_.empty() && !bundled_;
  if (mode == Mode::power && of_joint && leader_ != nullptr && moves_together())
    return axis_.pull_with(value);
  if (const Refusal own = may_heat(board); own != Refusal::none) return own;
  if (const Refusal group = group_admits(mode, board); group != Refusal::none) return group;
  if (const Reply reply = axis_.admits(mode, value); reply.refusal != Refusal::none) return reply;
  if (mode == Mode::power && of_joint) {
    const Reply pull = axis_.admits_against(others_.front()->axis_, value);
    if (pull.refusal != Refusal::none) return pull;
  }
  lead(mode);
  enter(mode, value);
  commands_.renewed = true;
  return Refusal::none;
}

void Channel::enter(Mode mode, double value) {
  if (state_.state() == State::armed) {
    state_.activate();
    axis_.start();
  }
  axis_.follow(mode, value);
}

/// A knot renews like a command to heat. A start does not: it may come from a Sync, not a command.
Reply Channel::play(const Command& command) {
  if (!state_.may_heat()) return Refusal::wrong_state;
  const Reply reply = axis_.play(command);
  if (reply.refusal == Refusal::none && command.verb == Verb::knot) commands_.renewed = true;
  return reply;
}

Refusal Channel::renew() {
  if (!state_.may_heat() || led()) return Refusal::wrong_state;
  commands_.renewed = true;
  return Refusal::none;
}

Refusal Channel::rest() {
  if (bundled_ && leader_ != nullptr) return leader_->rest();
  const bool all = bundled_ || moves_together() || waits_for_others();
  if (state_.rest() != Refusal::none) return Refusal::wrong_state;
  axis_.rest();
  abandon_others();
  if (!all) return Refusal::none;
  for (Channel* const other : others_)
    other->rest_now();
  return Refusal::none;
}

}  // namespace supercoil
