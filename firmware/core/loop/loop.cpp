#include "loop/loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace supercoil {

namespace {

constexpr int max_commands_per_tick = 64;
/// Time for buffered converters to have their first values, and for filters to settle.
constexpr double settling_s = 0.1;
/// After a longer stall the muscles are cold.
constexpr std::int64_t max_periods = 200'000;

SelfTest::Settings self_test_settings(const BoardSettings& s) {
  double filter_s = 0.0;
  for (const ChannelSettings& channel : s.channels)
    filter_s = std::max(filter_s, channel.heater.sense_filter_s);
  return {s.supervision.charge_pump_decay_s, std::max(0.05, 5.0 * filter_s),
          std::max(0.03, 8.0 * filter_s)};
}

std::size_t ring_rows(const BoardSettings& s) {
  return static_cast<std::size_t>(row_ring_s * s.rate_Hz) * s.channels.size();
}

}  // namespace

Loop::Loop(const BoardSettings& settings, const board::Devices& devices)
    : settings_(settings),
      devices_(devices),
      supervisor_(settings.supervision, settings.step_s()),
      self_test_(self_test_settings(settings), settings.step_s()),
      settling_ticks_(std::llround(settling_s * settings.rate_Hz)),
      rows_(ring_rows(settings)) {
  for (std::size_t i = 0; i < settings.channels.size(); ++i) {
    channels_.push_back(std::make_unique<Channel>(
        settings.channels[i], settings, devices.channels[i], static_cast<std::uint8_t>(i)));
    if (settings.joint_of(i) == nullptr && settings.bundle_of(i) == nullptr)
      single_.push_back(channels_.back().get());
  }
  for (const JointSettings& joint : settings.joints) {
    Channel& agonist = *channels_[joint.agonist];
    Channel& antagonist = *channels_[joint.antagonist];
    agonist.lead_joint(antagonist);
    joints_.emplace_back(joint, agonist.axis(), antagonist.axis(), settings.step_s());
  }
  for (const BundleSettings& bundle : settings.bundles) {
    std::vector<Channel*> followers;
    std::vector<Axis*> axes;
    for (std::size_t i = 1; i < bundle.channels.size(); ++i) {
      followers.push_back(channels_[bundle.channels[i]].get());
      axes.push_back(&followers.back()->axis());
    }
    Channel& leader = *channels_[bundle.leader()];
    bundles_.emplace_back(leader.axis(), std::move(axes));
    leader.lead_bundle(std::move(followers));
  }
}

void Loop::tick(hal::Time due, hal::Time woke, std::int64_t skipped) {
  // Sample: counts become volts, amperes and metres, each with its age.
  for (const auto& channel : channels_)
    channel->sample(woke);

  // Decide: commands, and whether anything may be hot.
  obey();
  judge_board(woke, hal::seconds(woke - due), skipped);
  for (Joint& joint : joints_)
    joint.observe();
  for (Bundle& bundle : bundles_)
    bundle.observe();
  for (const auto& channel : channels_)
    channel->supervise(now_);
  for (const auto& channel : channels_) {
    const Fault fault = channel->present_board_fault();
    if (fault != Fault::none) latch(fault, channel->verdict().margin(fault));
  }

  // Compute: learn from the power that acted, and find the power that is wanted.
  for (const auto& channel : channels_) {
    channel->estimate();
    channel->control();
  }
  for (Channel* const channel : single_)
    channel->limit();
  for (Joint& joint : joints_)
    joint.limit();
  for (Bundle& bundle : bundles_)
    bundle.limit();

  // Drive: watts become duties.
  if (!now_.proven) {
    run_self_test();
  } else {
    for (const auto& channel : channels_)
      channel->drive();
  }
  toggle_heartbeat();

  // Publish: rows for the recorder and for telemetry; then the light, which can wait.
  for (const auto& channel : channels_) {
    if (!rows_.push(row_of(channel->publish(now_, supervisor_.verdict()))))
      timing_.lost_rows.fetch_add(1, std::memory_order_relaxed);
  }
  update_light();
  if (devices_.watchdog != nullptr) devices_.watchdog->feed();
  last_tick_ = {woke - due, devices_.clock->now() - woke};
  timing_.add(last_tick_, skipped);
  ++ticks_;
}

bool Loop::send_tuning(Command command) {
  const bool known = command.channel < channels_.size();
  if (known) channels_[command.channel]->add_tuning(command);
  if (commands_.push(command)) return true;
  if (known) channels_[command.channel]->tuner().conclude({command, Refusal::queue_full});
  return false;
}

void Loop::conclude_tuning(const Answer& answer) {
  const std::uint8_t channel = answer.command.channel;
  if (channel < channels_.size()) channels_[channel]->tuner().conclude(answer);
}

void Loop::obey() {
  reset_requested_before_ = reset_requested_;
  reset_requested_ = false;
  std::uint8_t damaged = 0;
  while (damaged_.pop(damaged)) {
    if (damaged < channels_.size()) channels_[damaged]->note_damaged();
  }
  const auto obey_one = [this](const Command& command) {
    const Reply reply = reply_to(command);
    answers_.push({command, reply.refusal, reply.nearest});
  };
  for (int i = 0; i < max_commands_per_tick && commands_.consume_one(obey_one); ++i) {
  }
}

Reply Loop::reply_to(const Command& command) {
  if (!takes(command.verb, command.value)) return {Refusal::out_of_range, 0.0};
  if (command.channel >= channels_.size()) return Refusal::no_such_channel;
  if (command.verb == Verb::reset) reset_board();
  return channels_[command.channel]->answer(command, now_);
}

/// Acts on a rising edge of any channel's reset, while no detector of the board trips. Before the
/// heartbeat starts again, both ways of cutting must be proven again: a switch that is stuck on
/// carries no current while the supply is open.
void Loop::reset_board() {
  const bool edge = !reset_requested_ && !reset_requested_before_;
  reset_requested_ = true;
  if (!edge || board_fault_ == Fault::none || supervisor_.verdict().fault() != Fault::none) return;
  board_fault_ = Fault::none;
  now_.fault = Fault::none;
  now_.proven = false;  // also for the commands of this tick
  self_test_.restart();
}

void Loop::judge_board(hal::Time now, double late_s, std::int64_t skipped) {
  overruns_ += skipped;
  BoardInputs& e = inputs_;
  board::measure(devices_.supply->latest(), settings_.supply.scaling, now,
                 settings_.supply.max_age_s, e.supply);
  e.stop_circuit = devices_.stop_circuit->read();
  e.late_s = late_s;
  e.skipped = skipped;
  e.lines_ok = lines_ok_;
  for (const auto& channel : channels_)
    e.lines_ok = e.lines_ok && channel->lines_ok();
  e.telemetry_heartbeats = health_.telemetry_heartbeats.load(std::memory_order_relaxed);
  e.bus = health_.bus.load(std::memory_order_relaxed);
  e.node_conflict = health_.node_conflict.load(std::memory_order_relaxed);
  e.configuration_changed = health_.configuration_changed.load(std::memory_order_relaxed);
  e.self_test_failed = self_test_.failed();
  e.self_test_cut = self_test_.outcome() == SelfTest::Outcome::enable_does_not_cut ? 2 : 1;
  const Fault present = supervisor_.step(e);
  const Verdict& verdict = supervisor_.verdict();

  const bool settling = ticks_ < settling_ticks_;
  now_.time = now;
  now_.supply_V = e.supply.present ? e.supply.value : 0.0;
  now_.testing = self_test_.under_way() || (settling && !self_test_.failed());
  now_.proven = self_test_.passed();
  if (devices_.air != nullptr) measure_air(now);
  now_.periods = 1 + std::min(skipped, max_periods);
  if (verdict.board_fault() != Fault::none)
    latch(verdict.board_fault(), verdict.margin(verdict.board_fault()));
  now_.fault = board_fault_ != Fault::none ? board_fault_ : present;
  if (now_.fault != Fault::none) now_.margin = verdict.margin(now_.fault);
}

void Loop::measure_air(hal::Time now) {
  board::measure(devices_.air->latest(), settings_.air.scaling, now, settings_.air.max_age_s, air_);
  now_.air = &air_;
}

/// Keeps the first cause. From the next tick on no channel of this board may be hot; in this tick
/// they are made safe here.
void Loop::latch(Fault cause, const detectors::Margin& margin) {
  // During the self-test a board may look faulty; an emergency stop counts at any time.
  const bool judged = !now_.testing || cause == Fault::emergency_stop;
  if (board_fault_ != Fault::none || !judged) return;
  board_fault_ = cause;
  for (const auto& channel : channels_)
    channel->disarm(cause, margin);
}

/// The test lets the supply switch close for a moment, and proves nothing without a supply: it
/// waits for a closed stop circuit, a good supply, and a board without a fault.
bool Loop::may_test() const {
  bool quiet = board_fault_ == Fault::none && supervisor_.verdict().fault() == Fault::none &&
               inputs_.supply.present;
  for (const auto& channel : channels_)
    quiet = quiet && std::isfinite(channel->measured_current_A());
  return quiet;
}

void Loop::run_self_test() {
  double max_A = 0.0;
  double idle_A = 1e9;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const ChannelSettings& channel = settings_.channels[i];
    const double probe_A = channel.heater.probe_duty * settings_.supervision.min_supply_V /
                           channel.heater.cold_resistance_Ohm;
    max_A = std::fmax(max_A, channels_[i]->measured_current_A());
    idle_A = std::fmin(idle_A, std::fmin(channel.supervision.off_current_A, 0.5 * probe_A));
  }
  self_test_.step(may_test(), max_A, idle_A);
  const SelfTest::Lines lines = self_test_.lines();
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    channels_[i]->test_drive(lines.pulse ? settings_.channels[i].heater.probe_duty : 0.0,
                             lines.enable);
  }
}

/// The line's edges keep the supply switch closed; when they stop, the charge pump opens it.
void Loop::toggle_heartbeat() {
  const bool cut = board_fault_ != Fault::none || !(now_.proven || self_test_.lines().heartbeat);
  // Without edges the pump stops, but setting the line still shows whether it can be set.
  if (!cut) heartbeat_ = !heartbeat_;
  lines_ok_ = devices_.heartbeat->set(heartbeat_) == hal::Status::ok;
}

/// Off: disarmed. On: something is armed. Slow blinking: something is hot. Fast: a fault.
void Loop::update_light() {
  if (devices_.light == nullptr) return;
  bool fault = board_fault_ != Fault::none;
  bool active = false;
  bool armed = false;
  for (const auto& channel : channels_) {
    fault = fault || channel->state().state() == State::fault;
    active = active || channel->state().state() == State::active;
    armed = armed || channel->state().state() == State::armed;
  }
  const double half_period_s = fault ? 0.1 : 0.5;
  const auto half_period = static_cast<std::int64_t>(half_period_s * settings_.rate_Hz);
  if (++blink_ticks_ >= half_period) {
    blink_ticks_ = 0;
    blink_ = !blink_;
  }
  const bool lit = fault || active ? blink_ : armed;
  if (static_cast<int>(lit) == light_) return;
  devices_.light->set(lit);
  light_ = static_cast<int>(lit);
}

}  // namespace supercoil
